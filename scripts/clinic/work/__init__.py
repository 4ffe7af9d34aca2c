"""Work done once: tasks go in, their files come out, from the cache or made in parallel.

It may import `record` and `engine`.
"""
