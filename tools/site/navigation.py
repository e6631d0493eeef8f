"""The navigation: mkdocs.yml names pages and patterns, the tree says what they are."""

import fnmatch


def expand(nav, pages):
    """`nav` with each pattern replaced by the pages it fits that are named nowhere else, in the order of their names.

    Beside it, one line for each entry that fits no page and for each page of `pages` that is nowhere in it.
    """
    named = {entry for entry in entries_of(nav) if "*" not in entry}
    taken = set()
    problems = []

    def expand_entry(entry):
        if "*" in entry:
            fitting = [page for page in sorted(pages) if fnmatch.fnmatchcase(page, entry) and page not in named | taken]
        else:
            fitting = [entry] if entry in pages else []
        if not fitting:
            problems.append(f"mkdocs.yml: the navigation names '{entry}', but there is no such page; correct or delete the entry")
        taken.update(fitting)
        return fitting

    def expand_item(item):
        if isinstance(item, str):
            return expand_entry(item)
        (title, below), = item.items()
        if isinstance(below, str):
            return [{title: page} for page in expand_entry(below)]
        return [{title: [x for child in below for x in expand_item(child)]}]

    expanded = [x for item in nav for x in expand_item(item)]
    for page in sorted(set(pages) - taken):
        problems.append(f"{page}: the page is not in the navigation; add it to `nav` in mkdocs.yml under the section of its reader")
    return expanded, problems


def entries_of(nav):
    for item in nav:
        if isinstance(item, str):
            yield item
        else:
            for below in item.values():
                yield from entries_of([below] if isinstance(below, str) else below)
