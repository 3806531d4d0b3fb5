"""The text in a file, whatever encoding the program that wrote it preferred."""

from __future__ import annotations

import codecs
from pathlib import Path

# marks at the beginning of a file and what they mean; the longer ones first
_MARKS = (
    (codecs.BOM_UTF8, "utf-8-sig"),
    (codecs.BOM_UTF32_LE, "utf-32"),
    (codecs.BOM_UTF32_BE, "utf-32"),
    (codecs.BOM_UTF16_LE, "utf-16"),
    (codecs.BOM_UTF16_BE, "utf-16"),
)
# beginnings of files that are no text, and what they are
_BINARY = {
    b"PK\x03\x04": "a zip archive (a spreadsheet or NPZ?)",
    b"MATLAB": "a MATLAB file",
    b"\x89HDF": "an HDF5 file",
    b"\x93NUMPY": "a NumPy array",
    b"\x1f\x8b": "a gzip archive",
    b"SQLite": "an SQLite file",
}
# what is read instead
FORMS = (
    "a table of text with one line of names (time_s, sweep_deg or sweep_rad or sweep_count, "
    'pitch alike), an NPZ with arrays of these names, or JSON {"stroke": ..., "parameters": ...}'
)


def read_text(path: Path) -> tuple[str, tuple[str, ...]]:
    """The text of a file and what had to be guessed about its letters.

    Raises:
        FileNotFoundError: there is no such file.
        ValueError: the file is no text; names what is read.
    """
    raw = path.read_bytes()
    kind = next((words for mark, words in _BINARY.items() if raw.startswith(mark)), None)
    if kind is not None:
        raise ValueError(f"this is {kind}; what can be read is {FORMS}")

    encoding = next((name for mark, name in _MARKS if raw.startswith(mark)), None)
    encoding = encoding or _without_a_mark(raw)
    notices: tuple[str, ...] = ()
    try:
        text = raw.decode(encoding or "utf-8")
    except UnicodeDecodeError:
        # old loggers write the letters of Western Europe in one byte each: ° and µ in a header
        text = raw.decode("latin-1")
        notices = ("the file is not UTF-8: it was read as Latin-1",)
    if "\0" in text or _is_no_text(text):
        raise ValueError(f"this is no text; what can be read is {FORMS}")
    return text, notices


def _without_a_mark(raw: bytes) -> str | None:
    """UTF-16 without its mark: every other byte of Latin letters and digits is zero."""
    head = raw[:400]
    even, odd = head[0::2], head[1::2]
    if len(head) >= 8 and odd.count(0) > 0.8 * len(odd) and even.count(0) < 0.1 * len(even):
        return "utf-16-le"
    if len(head) >= 8 and even.count(0) > 0.8 * len(even) and odd.count(0) < 0.1 * len(odd):
        return "utf-16-be"
    return None


def _is_no_text(text: str) -> bool:
    """Whether control characters say that these are the bytes of something else."""
    head = text[:2000]
    control = sum(ord(letter) < 32 and letter not in "\t\r\n\f" for letter in head)
    return control > 0.02 * len(head)
