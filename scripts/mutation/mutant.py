"""A change of the source, and its text."""
import dataclasses

from mutation import source


@dataclasses.dataclass(frozen=True, order=True)
class Mutant:
    """Other text in the place of an expression, or of a statement with its semicolon."""
    file: str            # relative to the source tree
    start: int           # [byte] of the original text
    end: int
    text: str            # instead of it, on one line; empty for a deleted statement
    statement: bool      # whether it is a statement
    wrap: str = ""       # what both texts are passed through to have the same type
    demoted: tuple = ()  # (offset, text) of each `constexpr` that cannot be one any more

    def describe(self, text):
        """Returns "old -> new", with the old text's number where a line holds it repeatedly.

        `text` is that of the whole file.
        """
        original = text[self.start:self.end]
        repeated = text[text.rfind("\n", 0, self.start) + 1:self.start].count(original)
        number = " ({})".format(repeated + 1) if repeated else ""
        return source.readable("{}{} -> {}".format(
            source.flat(original), number, self.text or "(deleted)"))

    def line(self, text):
        """Returns the number and the text of the line."""
        number = source.line_of(text, self.start)
        return number, source.readable(text.split("\n")[number - 1].strip())
