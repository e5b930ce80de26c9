#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Reads the paths of all files of the repository from stdin, one a line, and prints each relative link or picture of their
Markdown pages that leads to no file of the repository, or to no heading of one. Exits with 1 if there is any."""

import html
import posixpath
import re
import sys
import unicodedata
from urllib.parse import unquote

FENCE = re.compile(r"^ {0,3}(```+|~~~+).*?^ {0,3}\1[`~]*\s*?$", re.M | re.S)
CODE = re.compile(r"(?<!`)(`+)(?!`)((?:(?!\n\s*\n).)+?)(?<!`)\1(?!`)", re.S)
HEADING = re.compile(r"^ {0,3}#{1,6}[ \t]+(.+?)[ \t]*#*[ \t]*$", re.M)
LINK = re.compile(
    r"\]\(\s*<?([^\s<>()]+)>?(?:\s+[\"'(].*?[\"')])?\s*\)"  # [text](target "title"), ![text](target)
    r"|^ {0,3}\[[^\]^]+\]:\s*<?([^\s<>]+)"  # [label]: target
    r"|<(?:a|img)\b[^>]*?\b(?:href|src)\s*=\s*[\"']([^\"']+)",  # HTML
    re.M | re.S)


def blank(match):
    """What is replaced keeps its number of lines."""
    return re.sub(r"[^\n]", " ", match.group())


def is_kept(letter):
    """Whether GitHub keeps a letter of a heading in its fragment: letters, marks, decimal digits, connectors, hyphens and blanks."""
    category = unicodedata.category(letter)
    return letter in "- " or category[0] in "LM" or category in ("Nd", "Pc")


def anchors(text):
    """The fragments by which GitHub knows the headings of a page, and those that the page sets itself."""
    text = FENCE.sub(blank, text)
    found = set(re.findall(r"<a\b[^>]*?\b(?:id|name)\s*=\s*[\"']([^\"']+)", text))
    counts = {}
    for heading in HEADING.findall(text):
        heading = re.sub(r"!?\[([^\]]*)\]\([^)]*\)", r"\1", heading)
        heading = html.unescape(re.sub(r"<[^>]*>", "", heading))
        name = "".join(filter(is_kept, heading.strip().lower())).replace(" ", "-")
        count = counts.get(name, 0)
        counts[name] = count + 1
        found.add(f"{name}-{count}" if count else name)
    return found


def read(path):
    with open(path, encoding="utf-8") as file:
        return file.read()


def fault(page, target, files, folders):
    """What is wrong with a link of a page; None if nothing is."""
    path, _, fragment = target.partition("#")
    path = posixpath.normpath(posixpath.join(posixpath.dirname(page), unquote(path))) if path else page
    if path not in files and path not in folders:
        return "no such file in the repository"
    if fragment and path.endswith(".md") and unquote(fragment) not in anchors(read(path)):
        return f"no such heading in {path}"
    return None


def main():
    files = set(sys.stdin.read().splitlines())
    folders = {"."} | {file[:i] for file in files for i, letter in enumerate(file) if letter == "/"}
    bad = False
    for page in sorted(file for file in files if file.endswith(".md")):
        text = CODE.sub(blank, FENCE.sub(blank, read(page)))
        for link in LINK.finditer(text):
            target = next(filter(None, link.groups()))
            if re.match(r"[A-Za-z][A-Za-z0-9+.-]*:|//", target):
                continue
            reason = fault(page, target, files, folders)
            if reason:
                print(f"{page}:{text.count(chr(10), 0, link.start()) + 1}: {target}: {reason}")
                bad = True
    return bad


sys.exit(main())
