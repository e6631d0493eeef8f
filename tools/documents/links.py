"""Relative links, anchors and images that lead nowhere, and pages that nothing leads to."""

import posixpath
import re
from urllib.parse import unquote

SCHEME = re.compile(r"^[a-zA-Z][a-zA-Z0-9+.\-]*:")


def resolve(page, target):
    """The path within the tree that a link on `page` names, and its anchor. None for what is not a relative link."""
    if SCHEME.match(target) or target.startswith("//"):
        return None
    path, _, anchor = unquote(target).partition("#")
    if not path:
        return page, anchor
    return posixpath.normpath(posixpath.join(posixpath.dirname(page), path)), anchor


def broken_links(root, pages):
    """One line for each link of `pages` (name to Page) that leads nowhere below the folder `root`."""
    for name, page in sorted(pages.items()):
        for link in page.links:
            resolved = resolve(name, link.target)
            if resolved is None:
                continue
            problem = problem_of(root, pages, *resolved, link)
            if problem:
                yield f"{name}:{link.line}: {problem}"


def problem_of(root, pages, path, anchor, link):
    kind = "image" if link.is_image else "link"
    if path.startswith(("..", "/")):
        return f"the {kind} '{link.target}' leaves the tree; make it relative and keep it inside"
    if not (root / path).exists():
        return f"the {kind} '{link.target}' leads nowhere: there is no {path}"
    if link.is_image and not (root / path).is_file():
        return f"the image '{link.target}' is no file"
    if anchor and path in pages and anchor not in pages[path].anchors:
        return f"the link '{link.target}' leads nowhere: {path} has no heading with the anchor '{anchor}'"
    return None


def orphans(pages, entry):
    """One line for each page that no other page links to; `entry` is where readers begin."""
    linked = {entry}
    for name, page in pages.items():
        for link in page.links:
            resolved = resolve(name, link.target)
            if resolved and resolved[0] != name:
                linked.add(resolved[0])
    for name in sorted(set(pages) - linked):
        yield f"{name}: no other page links to it; link it from where its reader comes from, or delete it"
