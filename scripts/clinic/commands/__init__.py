"""What the terminal offers: `cli` holds the commands, the other modules what they do and print.

It may import every folder.
"""
