"""A Markdown page taken apart: prose, table cells, headings, links. Code, comments and link targets are left out."""

import re
from dataclasses import dataclass, field

FENCE = re.compile(r"^\s*(`{3,}|~{3,})")
HEADING = re.compile(r"^(#{1,6})\s+(.*?)\s*#*\s*$")
RULE = re.compile(r"^\s*([-*_])(\s*\1){2,}\s*$")
UNDERLINE = re.compile(r"^(=+|-+)\s*$")
ITEM = re.compile(r"^(\s*)([-*+]|\d+[.)])\s+")
DELIMITER_ROW = re.compile(r"^\s*\|?\s*:?-+:?\s*(\|\s*:?-+:?\s*)*\|?\s*$")
DEFINITION = re.compile(r"^\s{0,3}\[([^\]]+)\]:\s*(<[^>]*>|\S+)")
TARGET = r"\(\s*(<[^>]*>|(?:[^()\s]|\([^()\s]*\))*)(?:\s+(?:\"[^\"]*\"|'[^']*'))?\s*\)"
IMAGE = re.compile(r"!\[([^\]]*)\]" + TARGET)
LINK = re.compile(r"\[((?:[^\[\]]|\[[^\]]*\])*)\]" + TARGET)
REFERENCE = re.compile(r"\[([^\[\]]+)\]\[([^\]]*)\]")
HTML_SOURCE = re.compile(r"<(img|a|source)\b[^>]*?\b(?:src|srcset|href)\s*=\s*[\"']([^\"']+)[\"']", re.I)
HTML_ANCHOR = re.compile(r"<\w+\b[^>]*?\b(?:id|name)\s*=\s*[\"']([^\"']+)[\"']", re.I)
HTML_TAG = re.compile(r"</?[A-Za-z][^<>]*>|<https?://[^<>]*>")
INLINE_CODE = re.compile(r"(`+)(.+?)\1(?!`)", re.S)
MATH = re.compile(r"\$[^$\n]+\$")
CODE_WORD = "Code"  # stands for a piece of inline code: one word, and a sentence may begin with it


@dataclass
class Text:
    """A paragraph, a list item, a table cell or a heading, without its mark-up."""
    line: int
    text: str


@dataclass
class Link:
    line: int
    target: str
    is_image: bool = False


@dataclass
class Page:
    paragraphs: list = field(default_factory=list)
    cells: list = field(default_factory=list)
    headings: list = field(default_factory=list)
    links: list = field(default_factory=list)
    anchors: set = field(default_factory=set)
    lines: list = field(default_factory=list)


def slug_of(heading):
    """The anchor that GitHub and the site (pymdownx.slugs) give a heading."""
    kept = re.sub(r"[^\w\- ]", "", heading.strip().lower())
    return kept.replace(" ", "-")


def without_comments(text):
    """HTML comments blanked, their line breaks kept; comments inside fenced code are code and stay."""
    out, fence, inside = [], None, False
    for line in text.split("\n"):
        if not inside:
            fence = fence_after(fence, line)
        if fence:
            out.append(line)
            continue
        kept = ""
        while line:
            if inside:
                _, mark, line = line.partition("-->")
                inside = not mark
            else:
                before, mark, line = line.partition("<!--")
                kept += before
                inside = bool(mark)
        out.append(kept)
    return out


def fence_after(fence, line):
    """The fence that is open after `line`, given the one open before it; None: none."""
    found = FENCE.match(line)
    if not found:
        return fence
    mark = found.group(1)
    if fence is None:
        return mark
    closes = mark[0] == fence[0] and len(mark) >= len(fence) and line.strip() == mark
    return None if closes else fence


class Reader:
    """Goes through the lines once and gathers them into blocks."""

    def __init__(self, text):
        self.page = Page(lines=text.split("\n"))
        self.definitions = {}
        self.block = []
        self.block_line = 0
        self.inside_list = False

    def read(self):
        lines = without_comments("\n".join(self.page.lines))
        for line in lines:
            found = DEFINITION.match(line)
            if found:
                self.definitions[found.group(1).lower()] = found.group(2)
        fence, skip = None, 0
        for number, line in enumerate(lines, 1):
            was_open = fence is not None
            fence = fence_after(fence, line)
            if fence or was_open:
                self.end_block()
            elif skip:
                skip -= 1
            else:
                skip = self.read_line(lines, number, line)
        self.end_block()
        return self.page

    def read_line(self, lines, number, line):
        """Returns how many of the next lines have been read as well."""
        line = re.sub(r"^\s{0,3}(>\s?)+", "", line)
        following = lines[number] if number < len(lines) else ""
        if not line.strip():
            self.end_block()
        elif HEADING.match(line):
            self.end_block()
            self.inside_list = False
            self.add_heading(number, HEADING.match(line).group(2))
        elif "|" in line and "|" in following and DELIMITER_ROW.match(following):
            self.end_block()
            return self.read_table(lines, number)
        elif self.block and len(self.block) == 1 and UNDERLINE.match(line) and not self.inside_list:
            heading, at = self.block[0], self.block_line
            self.block = []
            self.add_heading(at, heading)
        elif RULE.match(line) or DEFINITION.match(line):
            self.end_block()
        else:
            self.read_prose(number, line)
        return 0

    def read_prose(self, number, line):
        item = ITEM.match(line)
        if item:
            self.end_block()
            self.inside_list = True
            line = line[item.end():]
        elif not self.block:
            if not line.startswith((" ", "\t")):
                self.inside_list = False
            elif line.startswith(("    ", "\t")) and not self.inside_list:
                return  # indented code
        if not self.block:
            self.block_line = number
        self.block.append(line.strip())

    def read_table(self, lines, number):
        rows = 0
        for offset, line in enumerate(lines[number - 1:]):
            if "|" not in line:
                break
            rows += 1
            if offset == 1:
                continue
            covered = INLINE_CODE.sub(lambda m: m.group(0).replace("|", "\0"), line.strip()).replace("\\|", "\0")
            for cell in covered.strip("|").split("|"):
                text = self.plain(number + offset, cell.replace("\0", "|").strip())
                if text:
                    self.page.cells.append(Text(number + offset, text))
        return rows - 1

    def end_block(self):
        if self.block:
            text = self.plain(self.block_line, "\n".join(self.block))
            if text:
                self.page.paragraphs.append(Text(self.block_line, text))
        self.block = []

    def add_heading(self, number, text):
        shown = INLINE_CODE.sub(lambda m: m.group(2), text)
        shown = LINK.sub(lambda m: m.group(1), IMAGE.sub("", shown))
        slug = slug_of(re.sub(r"[*]+|\\", "", HTML_TAG.sub("", shown)))
        self.page.anchors.add(slug)
        self.page.headings.append(Text(number, self.plain(number, text)))

    def plain(self, number, text):
        """The text without mark-up; notes its links and anchors."""
        text = INLINE_CODE.sub(CODE_WORD, text)
        text = MATH.sub(CODE_WORD, text)

        def note(target, at, is_image):
            line = number + text.count("\n", 0, at)
            self.page.links.append(Link(line, target.strip("<>"), is_image))

        for found in HTML_SOURCE.finditer(text):
            note(found.group(2), found.start(), found.group(1).lower() != "a")
        self.page.anchors.update(m.group(1) for m in HTML_ANCHOR.finditer(text))
        for found in IMAGE.finditer(text):
            note(found.group(2), found.start(), True)
        text = IMAGE.sub(lambda m: "\n" * m.group(0).count("\n"), text)
        for found in LINK.finditer(text):
            note(found.group(2), found.start(), False)
        text = LINK.sub(lambda m: m.group(1), text)
        for found in REFERENCE.finditer(text):
            name = (found.group(2) or found.group(1)).lower()
            if name in self.definitions:
                note(self.definitions[name], found.start(), False)
        text = REFERENCE.sub(lambda m: m.group(1) if (m.group(2) or m.group(1)).lower() in self.definitions else m.group(0), text)
        text = HTML_TAG.sub(" ", text)
        text = re.sub(r"(\*\*|__|\*|(?<!\w)_|_(?!\w)|~~)", "", text)
        text = re.sub(r"\\([\\`*_{}\[\]()#+\-.!|])", r"\1", text)
        return re.sub(r"\s+", " ", text).strip()


def read_page(text):
    return Reader(text).read()
