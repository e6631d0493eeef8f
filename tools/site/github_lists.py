"""Lists as GitHub reads them, written as Python-Markdown reads them.

GitHub (CommonMark) takes a list that follows a paragraph line at once, and nests by the width of the item's mark.
Python-Markdown wants an empty line before a list and four blanks for each level. Pages are written for both.
"""

import re

ITEM = re.compile(r"^( *)([-*+]|\d{1,9}[.)])( +)(?=\S)")
FENCE = re.compile(r"^ *(`{3,}|~{3,})")
RULE = re.compile(r"^ {0,3}([-*_])( *\1){2,} *$")


def interrupts_paragraph(mark):
    """A list that begins with another number than 1 is the paragraph's own text."""
    return not mark[:-1].isdigit() or mark[:-1] == "1"


class Lists:
    def __init__(self):
        self.offsets = []  # where the text of each open item begins, outermost first
        self.fence = None
        self.shift = 0  # of the lines of the open fence
        self.previous = ""
        self.out = []

    def rewrite(self, text):
        for line in text.split("\n"):
            self.rewrite_line(line)
            self.previous = line
        return "\n".join(self.out)

    def rewrite_line(self, line):
        stripped = line.strip()
        if self.fence:
            self.out.append(self.shifted(line) if stripped else "")
            if stripped == self.fence:
                self.fence = None
            return
        if not stripped:
            self.out.append("")
            return
        item = None if RULE.match(line) else ITEM.match(line)
        if item and self.opens(item, line):
            return
        indent = len(line) - len(line.lstrip(" "))
        if not self.previous.strip() or FENCE.match(line):
            self.close_deeper_than(indent)
        nested = self.nested(line)
        self.out.append(nested)
        fence = FENCE.match(line)
        if fence:
            self.fence = fence.group(1)
            self.shift = len(nested) - len(line)

    def opens(self, item, line):
        """Writes the line of an item. False if it is none, but text."""
        indent = len(item.group(1))
        before = list(self.offsets)
        self.close_deeper_than(indent)
        inside_paragraph = bool(self.previous.strip()) and not ITEM.match(self.previous) and not before
        if indent - (self.offsets[-1] if self.offsets else 0) > 3:
            self.offsets = before
            return False
        if inside_paragraph and not interrupts_paragraph(item.group(2)):
            self.offsets = before
            return False
        if inside_paragraph:
            self.out.append("")
        self.out.append(" " * 4 * len(self.offsets) + line[indent:])
        width = len(item.group(2)) + (len(item.group(3)) if len(item.group(3)) <= 4 else 1)
        self.offsets.append(indent + width)
        return True

    def close_deeper_than(self, indent):
        while self.offsets and indent < self.offsets[-1]:
            self.offsets.pop()

    def shifted(self, line):
        return " " * self.shift + line if self.shift >= 0 else line[min(-self.shift, len(line) - len(line.lstrip(" "))):]

    def nested(self, line):
        indent = len(line) - len(line.lstrip(" "))
        depth = sum(1 for offset in self.offsets if indent >= offset)
        if not depth:
            return line
        code = indent - self.offsets[depth - 1]  # four blanks and more are indented code
        return " " * (4 * depth + (code if code > 3 else 0)) + line.lstrip(" ")


def as_python_markdown(text):
    return Lists().rewrite(text)
