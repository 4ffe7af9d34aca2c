"""What mkdocs-gen-files calls: the site's pages, written into the build."""

from clinic.publish.mkdocs import write

write()
