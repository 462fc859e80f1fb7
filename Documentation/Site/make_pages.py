# SPDX-License-Identifier: BSD-3-Clause
"""Makes pages of this repository fit for Doxygen.

    make_pages.py REPOSITORY FOLDER

Writes to FOLDER each page of the documentation with a label at each of its headings, so that links lead where
they lead in the repository; the pictures that it shows; and pages of the examples.
"""

import html
import os
import pathlib
import re
import shutil
import sys

FENCE = re.compile(r"^(```.*?^```)$", re.MULTILINE | re.DOTALL)
HEADING = re.compile(r"^(#+) (.*)$", re.MULTILINE)
IMAGE = re.compile(r"!\[([^\]]*)\]\(([^)]+)\)|<img\s+src=\"([^\"]+)\"([^>]*)>")
LINK = re.compile(r"\[((?:[^\[\]]|\[[^\]]*\])*)\]\(([^)\s]+)\)")
# What Doxygen shows as it is, and a browser opens.
ELSEWHERE = re.compile(r"[a-z]+:")


def slug(heading):
    """A heading's anchor in the repository."""
    words = re.sub(r"[^\w\- ]", "", re.sub(r"[`*_]", "", heading).lower())
    return words.strip().replace(" ", "-")


def labelled(page, heading):
    return page + "-" + re.sub(r"\W", "-", slug(heading))


class Site:
    def __init__(self, repository, folder):
        self.repository = repository
        self.folder = folder
        documentation = repository / "Documentation"
        galleries = [page for folder in ("Gallery", "PyVista") for page in sorted((documentation / folder).glob("*.md"))]
        sources = [repository / "README.md", *sorted(documentation.glob("*.md")), *galleries]
        self.pages = {path: path.stem for path in sources}
        if len(set(self.pages.values())) < len(sources):
            sys.exit("two pages have one name: " + ", ".join(path.name for path in sources))

    def picture(self, page, target):
        """Copies a picture and returns its place in the site."""
        source = (page.parent / target).resolve()
        place = source.relative_to(self.repository)
        copy = self.folder.parent / "html" / place
        copy.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(source, copy)
        return place.as_posix()

    def image(self, page, match):
        text, target, source, rest = match.groups()
        attributes = rest if source else ' alt="' + html.escape(text) + '"'
        return f'<img src="{self.picture(page, source or target)}"{attributes}>'

    def link(self, page, match):
        text, target = match.groups()
        if ELSEWHERE.match(target):
            return match.group(0)
        file, _, anchor = target.partition("#")
        path = (page.parent / file).resolve() if file else page
        if path in self.pages:
            name = self.pages[path]
            label = labelled(name, anchor) if anchor else ("index" if name == "README" else name)
            return f"[{text}](@ref {label})"
        if path.suffix in (".cxx", ".py") and (self.repository / "Examples") in path.parents:
            return f"[{text}](@ref {self.example_label(path)})"
        # A file of the repository, which the site does not have.
        return text if text.startswith("`") else f"{text} (`{path.relative_to(self.repository)}`)"

    @staticmethod
    def example_label(path):
        return "example-" + path.name.replace(".", "-")

    def prose(self, page, text):
        """A text without blocks of code."""
        name = self.pages[page]

        def heading(match):
            level, words = match.groups()
            plain = words.replace("`", "")
            if level == "#":
                return f"# {plain}" if name == "README" else f"# {plain} {{#{name}}}"
            return f"{level} {plain} {{#{labelled(name, words)}}}"

        text = HEADING.sub(heading, text)
        text = IMAGE.sub(lambda match: self.image(page, match), text)
        text = LINK.sub(lambda match: self.link(page, match), text)
        text = re.sub(r"<!--.*?-->\n?", "", text, flags=re.DOTALL)
        # Doxygen takes #word for a link.
        return re.sub(r"(?<=[^\n#{`])#(?=[A-Za-z])", r"\\#", text)

    def write_page(self, page):
        parts = FENCE.split(page.read_text(encoding="utf-8"))
        for at in range(0, len(parts), 2):
            parts[at] = self.prose(page, parts[at])
        for at in range(1, len(parts), 2):
            # Languages that Doxygen colours; others are texts.
            parts[at] = re.sub(r"^```(\w*)", lambda m: "```" + {"python": "{.py}", "cpp": "{.cpp}"}.get(
                m.group(1), "{.unparsed}"), parts[at])
        (self.folder / (self.pages[page] + ".md")).write_text("".join(parts), encoding="utf-8")

    def write_examples(self):
        """A page for each example, and one that lists them."""
        rows = []
        for path in sorted((self.repository / "Examples").glob("*/*.*")):
            if path.suffix not in (".cxx", ".py"):
                continue
            source = path.read_text(encoding="utf-8")
            # What it says about itself at its beginning.
            about = re.search(r'(?s)"""(.*?)"""' if path.suffix == ".py" else r"(?m)((?:^// (?!SPDX).*\n)+)", source)
            words = about.group(1) if about else ""
            words = html.escape(" ".join(re.sub(r"^//", "", words, flags=re.MULTILINE).split()), quote=False)
            label = self.example_label(path)
            language = "{.py}" if path.suffix == ".py" else "{.cpp}"
            (self.folder / (label + ".md")).write_text(
                f"# {path.name} {{#{label}}}\n\n{words}\n\n~~~{language}\n{source}~~~\n", encoding="utf-8")
            rows.append(f"- [{path.name}](@ref {label}): {words}\n")
        (self.folder / "Examples.md").write_text(
            "# Examples {#Examples}\n\nShort programs; each is run by a test.\n\n" + "".join(rows),
            encoding="utf-8")

    def write(self):
        os.makedirs(self.folder, exist_ok=True)
        for page in self.pages:
            self.write_page(page)
        self.write_examples()


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    Site(pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()).write()
