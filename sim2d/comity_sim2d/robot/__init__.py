"""The robot: commands in, motion and acts out."""
