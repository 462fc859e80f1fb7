#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs the examples of a page of the documentation, so that none of them goes stale.

    run_examples.py PAGE.md --scratch FOLDER [--prefix PREFIX] [--program-folder FOLDER]

What a fenced block is depends on its language:

  python   run as it stands, with the package on PYTHONPATH; each is complete in itself
  cpp      a whole program, built with the page's cmake block (or Documentation/Building.md's)
           against the installed package in PREFIX, and run
  sh       run by bash; reliefshade is on the PATH
  cmake    used by the cpp blocks
  others   for reading only: console for commands that are not run, text, js, which Testing/Web runs

Blocks run in order in the folder SCRATCH, in which Examples is the repository's, and may use the files
that earlier ones have written. A line that ends in a comment "prints ..." must print just that.
A block with the comment <!-- not run: reason --> on the line before it is skipped.

Also checks the page's links to files of the repository, and their headings.
"""

import argparse
import os
import re
import shutil
import subprocess
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
LANGUAGES = ("python", "cpp", "sh", "cmake")
READING = ("console", "text", "glsl", "js")


class Block:
    def __init__(self, language, line, text):
        self.language, self.line, self.text = language, line, text

    def expected(self):
        """What the comments say that the block prints."""
        return re.findall(r"(?:#|//) prints (.*?)\s*$", self.text, re.MULTILINE)


def blocks_of(path):
    """The fenced blocks of a page. A fence without a known language is a mistake."""
    blocks, block, skip = [], None, False
    with open(path, encoding="utf-8") as file:
        lines = file.read().splitlines()
    for number, line in enumerate(lines, 1):
        if block is None and line.startswith("```"):
            language = line[3:].strip()
            if language not in LANGUAGES + READING:
                fail(path, number, f"a block's language is '{language}', one of "
                                   f"{', '.join(LANGUAGES + READING)} is expected")
            block = Block(language, number, "")
            skip = number > 1 and lines[number - 2].startswith("<!-- not run")
        elif block is not None and line == "```":
            if block.language in LANGUAGES and not skip:
                blocks.append(block)
            block = None
        elif block is not None:
            block.text += line + "\n"
    if block is not None:
        fail(path, block.line, "a block does not end")
    return blocks


def fail(path, line, message):
    print(f"{os.path.relpath(path, ROOT)}:{line}: {message}")
    sys.exit(1)


def check_links(path):
    with open(path, encoding="utf-8") as file:
        text = file.read()
    # Examples in blocks are no links.
    text = re.sub(r"^```.*?^```$", lambda m: "\n" * m.group(0).count("\n"), text,
                  flags=re.MULTILINE | re.DOTALL)
    targets = re.finditer(r"\]\(([^)\s]+)\)|(?:src|href)=\"([^\"]+)\"", text)
    for match in targets:
        target = match.group(1) or match.group(2)
        if "://" in target:
            continue
        line = text.count("\n", 0, match.start()) + 1
        name, _, heading = target.partition("#")
        file_name = os.path.join(os.path.dirname(path), name) if name else path
        if not os.path.exists(file_name):
            fail(path, line, f"the link leads to {target}, which does not exist")
        if heading and heading not in headings_of(file_name):
            fail(path, line, f"the link leads to {target}, but there is no such heading")


def headings_of(path):
    """The anchors that a page's headings get."""
    with open(path, encoding="utf-8") as file:
        titles = re.findall(r"^#+ +(.*)$", file.read(), re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", title.lower()).replace(" ", "-") for title in titles}


def run(command, block, page, scratch, environment):
    result = subprocess.run(command, cwd=scratch, env=environment, stdin=subprocess.DEVNULL,
                            stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
    if result.returncode != 0:
        print(result.stdout)
        fail(page, block.line, f"the {block.language} block ends with {result.returncode}")
    return result.stdout


def check_output(output, block, page):
    printed = [line.strip() for line in output.splitlines() if line.strip()]
    if block.expected() and printed != block.expected():
        fail(page, block.line, f"the block prints {printed}, its comments say {block.expected()}")


def build(block, cmake_text, scratch, environment, page, prefix):
    """Builds a program and returns its path."""
    project = re.search(r"add_executable\((\w+)\s+([\w.]+)", cmake_text)
    target, source = project.groups()
    folder = os.path.join(scratch, f"{target}-{block.line}")
    os.makedirs(folder, exist_ok=True)
    for name, text in ((source, block.text), ("CMakeLists.txt", cmake_text)):
        with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
            file.write(text)
    flags = os.environ.get("EXAMPLE_CMAKE_OPTIONS", "").split()
    run(["cmake", "-S", folder, "-B", folder, f"-DCMAKE_PREFIX_PATH={prefix}", *flags], block, page,
        scratch, environment)
    run(["cmake", "--build", folder], block, page, scratch, environment)
    return os.path.join(folder, target)


def main():
    parser = argparse.ArgumentParser(description="Run the examples of a page.")
    parser.add_argument("page")
    parser.add_argument("--scratch", required=True)
    parser.add_argument("--prefix", help="where the package is installed")
    parser.add_argument("--program-folder", help="where reliefshade is")
    arguments = parser.parse_args()

    page = os.path.abspath(arguments.page)
    scratch = os.path.abspath(arguments.scratch)
    shutil.rmtree(scratch, ignore_errors=True)
    os.makedirs(scratch)
    os.symlink(os.path.join(ROOT, "Examples"), os.path.join(scratch, "Examples"))

    environment = dict(os.environ)
    if arguments.program_folder:
        environment["PATH"] = arguments.program_folder + os.pathsep + environment["PATH"]

    check_links(page)
    blocks = blocks_of(page)
    cmake_blocks = [block for block in blocks if block.language == "cmake"] or [
        block for block in blocks_of(os.path.join(ROOT, "Documentation", "Building.md"))
        if block.language == "cmake"]
    count = 0
    for block in blocks:
        if block.language == "python":
            output = run([sys.executable, "-c", block.text], block, page, scratch, environment)
        elif block.language == "cpp":
            program = build(block, cmake_blocks[0].text, scratch, environment, page, arguments.prefix)
            output = run([program], block, page, scratch, environment)
        elif block.language == "sh":
            if not arguments.program_folder:
                print(f"line {block.line}: not run, there is no reliefshade in this build")
                continue
            output = run(["bash", "-euo", "pipefail", "-c", block.text], block, page, scratch,
                         environment)
        else:
            continue
        check_output(output, block, page)
        count += 1
    print(f"{os.path.relpath(page, ROOT)}: {count} examples ran")


if __name__ == "__main__":
    main()
