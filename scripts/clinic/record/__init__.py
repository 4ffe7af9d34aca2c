"""What an author writes: a case's folder goes in, a validated `Case` comes out, or every problem at its line.

It may import nothing else of the package, and runs nothing.
"""
