"""Words on a page: a record's prose and the evidence go in, Markdown comes out.

It may import `record`, `engine`, `work`, `proof` and `triage`.
"""
