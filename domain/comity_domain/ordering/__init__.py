"""The best order of visits, settled once ways are measured; insertion where the search proves nothing."""
