"""The interface to robots: the protocol, its readings, and signals noticed from people."""
