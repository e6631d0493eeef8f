#!/usr/bin/env python3
"""Follows every relative link and picture of the built site's pages and says which lead nowhere.

  tools/site/check_site.py out/docs    exit code 1 and one line per broken link

Doxygen's pages (api/) are looked at as targets alone: Doxygen warns about its own links.
"""

import html.parser
import os
import pathlib
import sys
from urllib.parse import unquote, urlsplit


class Links(html.parser.HTMLParser):
    def __init__(self):
        super().__init__()
        self.targets = set()
        self.anchors = set()

    def handle_starttag(self, tag, attributes):
        for name, value in attributes:
            if name in ("id", "name") and value:
                self.anchors.add(value)
            elif name in ("href", "src") and value:
                self.targets.add(value)


def links_of(path):
    links = Links()
    links.feed(path.read_text(encoding="utf-8"))
    return links


def broken(site):
    pages = {path: links_of(path) for path in sorted(site.rglob("*.html")) if path.relative_to(site).parts[0] != "api"}
    for page, links in pages.items():
        if page.name == "404.html":
            continue  # its links are absolute: it is served from anywhere
        for target in sorted(links.targets):
            parts = urlsplit(target)
            if parts.scheme or parts.netloc:
                continue
            path = pathlib.Path(os.path.normpath(page.parent / unquote(parts.path))) if parts.path else page
            if path.is_dir():
                path = path / "index.html"
            name = page.relative_to(site)
            if not path.is_file():
                yield f"{name}: '{target}' leads nowhere: the site has no {os.path.relpath(path, site)}"
            elif parts.fragment and path in pages and unquote(parts.fragment) not in pages[path].anchors:
                yield f"{name}: '{target}' leads nowhere: the page has no anchor '{parts.fragment}'"


def main():
    if len(sys.argv) != 2 or not pathlib.Path(sys.argv[1], "index.html").is_file():
        sys.exit("check_site.py: give the folder of a built site, as out/docs; ./cairn.sh docs builds it.")
    found = list(broken(pathlib.Path(sys.argv[1]).resolve()))
    for line in found:
        print(line, file=sys.stderr)
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
