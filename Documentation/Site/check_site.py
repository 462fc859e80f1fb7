# SPDX-License-Identifier: BSD-3-Clause
"""Follows every link within a site.

    check_site.py FOLDER

Fails where one leads nowhere, and where the site has no search.
"""

import html.parser
import pathlib
import sys
import urllib.parse


class Page(html.parser.HTMLParser):
    def __init__(self, path):
        super().__init__()
        self.anchors, self.links = set(), []
        self.feed(path.read_text(encoding="utf-8"))

    def handle_starttag(self, tag, attributes):
        for name, value in attributes:
            if value and (name == "id" or (tag == "a" and name == "name")):
                self.anchors.add(value)
            if value and name in ("href", "src"):
                self.links.append(value)


def check(folder):
    pages = {path.name: Page(path) for path in folder.glob("*.html")}
    wrong = []
    for name, page in sorted(pages.items()):
        for link in page.links:
            parts = urllib.parse.urlsplit(link)
            if parts.scheme or parts.netloc or link.startswith("javascript"):
                continue
            target = urllib.parse.unquote(parts.path) or name
            if not (folder / target).exists():
                wrong.append(f"{name}: {link} is not there")
            elif parts.fragment and target in pages and parts.fragment not in pages[target].anchors:
                wrong.append(f"{name}: {link} has no such heading")
    if not list((folder / "search").glob("all_*.js")):
        wrong.append("the site cannot be searched")
    if len(pages) < 30:
        wrong.append(f"there are {len(pages)} pages only")
    print("\n".join(wrong))
    return not wrong


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    sys.exit(0 if check(pathlib.Path(sys.argv[1])) else 1)
