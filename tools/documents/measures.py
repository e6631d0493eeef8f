"""Words, sentences and numbers of a page."""

import re
from dataclasses import dataclass

# A full stop after one of these ends no sentence. Single capital letters (initials) do not either.
ABBREVIATIONS = ("e.g", "i.e", "cf", "vs", "ca", "approx", "resp", "al", "Fig", "Figs", "Eq", "Eqs", "Sec", "Ch", "No",
                 "Dr", "Mr", "Mrs", "Ms", "Prof", "St", "Vol", "pp", "p", "Ed", "Inc", "Ltd")
END = re.compile(r"[.!?][\"'”’)\]]*(?=\s+[\"'“‘(\[]*[A-Z0-9])")
NUMBER = re.compile(r"(?<![\w.])[+\-±−]?\d+(?:[.,/:^·]-?\d+|[eE]-?\d+)*(?:%|°)?(?![\w])")


@dataclass
class Sentence:
    line: int
    text: str
    words: int


@dataclass
class Measures:
    words: int
    sentences: list
    prose_words: int
    numbers: int

    @property
    def mean_sentence(self):
        return self.prose_words / len(self.sentences) if self.sentences else 0.0

    @property
    def longest(self):
        return max(self.sentences, key=lambda s: s.words, default=Sentence(0, "", 0))

    @property
    def numbers_per_hundred(self):
        return 100.0 * self.numbers / self.prose_words if self.prose_words else 0.0


def words_in(text):
    """A word is anything between blanks that has a letter or a digit."""
    return sum(1 for word in text.split() if any(c.isalnum() for c in word))


def ends_here(text, end):
    """Whether the stop at `end` (its index) ends a sentence, or only an abbreviation."""
    if text[end] != ".":
        return True
    word = re.search(r"[\w.]*$", text[max(0, end - 20):end]).group(0)
    if word in ABBREVIATIONS:
        return False
    return not (len(word) == 1 and word.isupper() and word != "I")


def sentences_of(text):
    start = 0
    for found in END.finditer(text):
        if ends_here(text, found.start()):
            yield text[start:found.end()].strip()
            start = found.end()
    rest = text[start:].strip()
    if words_in(rest):
        yield rest


def measure(page):
    """Of an item or paragraph every sentence; cells and headings are words only."""
    sentences = [Sentence(block.line, s, words_in(s)) for block in page.paragraphs for s in sentences_of(block.text)]
    sentences = [s for s in sentences if s.words]
    prose = sum(s.words for s in sentences)
    others = sum(words_in(block.text) for block in page.cells + page.headings)
    numbers = sum(len(NUMBER.findall(block.text)) for block in page.paragraphs)
    return Measures(prose + others, sentences, prose, numbers)
