"""A site: the pages as {path: bytes} go in, a MkDocs site comes out. The only folder that knows MkDocs.

It may import every folder before it.
"""
