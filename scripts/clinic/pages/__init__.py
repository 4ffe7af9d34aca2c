"""Pages: cases with their evidence go in; Markdown, plots, films and the playground's data come out, as {path: bytes}.

It may import every folder before it: `record`, `engine`, `work`, `proof`, `triage`. It knows no site builder.
"""
