"""Source text by byte offsets, as libclang counts them."""
import re


def read(path):
    """Returns a file's text with one character for each byte."""
    with open(path, encoding="latin-1", newline="") as file:
        return file.read()


def write(path, text):
    with open(path, "w", encoding="latin-1", newline="") as file:
        file.write(text)


def readable(text):
    """Returns text from `read` as what the file's author wrote."""
    return text.encode("latin-1").decode("utf-8", "replace")


def flat(text):
    """Returns the text on one line, without comments."""
    without = re.sub(r'("(?:\\.|[^"\\])*")|//[^\n]*|/\*.*?\*/',
                     lambda match: match.group(1) or " ", text, flags=re.S)
    return re.sub(r"\s+", " ", without).strip()


def line_of(text, offset):
    """Returns the number of a line, from 1."""
    return text.count("\n", 0, offset) + 1


def semicolon_after(text, end):
    """Returns the offset behind the semicolon that follows, None where something else does."""
    match = re.compile(r"(?:\s|//[^\n]*\n|/\*.*?\*/)*;", re.S).match(text, end)
    return match.end() if match else None
