"""Is it true? A `Case` goes in; its evidence comes out, and every law that the evidence breaks.

It may import `record`, `engine` and `work`.
"""
