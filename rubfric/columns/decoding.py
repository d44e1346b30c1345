"""The text of a file of measured columns, whatever its encoding."""

from __future__ import annotations

import codecs
import os
import re
import unicodedata
from collections.abc import Sequence

from rubfric.columns import workbook
from rubfric.errors import InvalidInput

# Longer marks first: that of UTF-32 begins with that of UTF-16.
_MARKS = {
    codecs.BOM_UTF8: "utf-8-sig",
    codecs.BOM_UTF32_LE: "utf-32",
    codecs.BOM_UTF32_BE: "utf-32",
    codecs.BOM_UTF16_LE: "utf-16",
    codecs.BOM_UTF16_BE: "utf-16",
}
# encoding: its name in words, and what encodes the common characters of its script alone
_GUESSES = {
    "cp1252": ("Western European", None),
    "cp932": ("Shift-JIS", "shift_jis"),
    "gb18030": ("Chinese, GBK", "gb2312"),
    "cp949": ("Korean", "euc_kr"),
    "big5": ("Chinese, Big5", "big5"),
    "euc_jp": ("Japanese, EUC", "euc_jp"),
    "cp1251": ("Cyrillic", None),
}
_ARCHIVE = b"PK\x03\x04"
_SYMBOLS = "°µ²³±·×§«»“”„‘’–—…€"
# Bytes by which the encoding is guessed, and the share of zeros that makes text of two bytes a character.
_LOOKED_AT, _ZEROS = 100_000, 0.3
# Characters that text has at most by accident.
_CONTROLS, _MOST_CONTROLS = bytes({*range(32)} - {*b"\t\n\v\f\r\x1b"}), 0.005
_WORDS, _CAMEL = re.compile(r"[^\W\d_]+"), re.compile(r"\w[À-ÞА-Я][a-zß-ÿа-я]")
# First byte of the last character in daily use.
_DAILY = {"shift_jis": 0x98, "gb2312": 0xD7, "euc_jp": 0xCF, "big5": 0xC6, "euc_kr": 0}


def decode(path: str, encoding: str | None, words: Sequence[str]) -> tuple[str, str]:
    """Return a file's text, and a note where its encoding was guessed.

    Parameters
    ----------
    path : str
    encoding : str or None
        None to find it out: a byte-order mark, UTF-8, or the encoding in which the text reads best.
    words : sequence of str
        Headings to be expected: an encoding in which the text has them comes first.

    Raises
    ------
    InvalidInput
        For a folder, a file that is neither text nor a workbook (.xls, with the extra ``xls``), and bytes that have
        no meaning in the encoding.
    FileNotFoundError
        For a missing file.
    """
    if os.path.isdir(path):
        raise InvalidInput(f"{path} is a folder, but must be a file of measured values")
    with open(path, "rb") as stream:
        content = stream.read()
    if content.startswith(workbook.MARK):
        return workbook.sheet_text(path, content), ""
    known = encoding or next((name for mark, name in _MARKS.items() if content.startswith(mark)), None)
    known = known or _of_two_bytes(content)
    # A logger that lost its power leaves zeros, others an end-of-file mark.
    content = content if known else content.rstrip(b"\0\x1a")
    sheet = "an Excel file (.xlsx) or an archive" if content.startswith(_ARCHIVE) else ""
    odd = len(content) - len(content.translate(None, _CONTROLS))
    if known is None and (sheet or odd > _MOST_CONTROLS * len(content)):
        raise InvalidInput(f"{path} is {sheet or 'no text file'}: export the table as text (CSV)")
    try:
        return content.decode(known or "utf-8").removeprefix("\ufeff"), ""
    except UnicodeDecodeError as error:
        if known:
            line = content.count(b"\n", 0, error.start) + 1
            raise InvalidInput(
                f"{path} is not in the encoding {known}: byte {content[error.start]:#04x} in line {line} has no "
                "meaning in it; export the record as UTF-8, or name its encoding under encoding in the YAML file of "
                "--columns"
            ) from error
    return _guessed(path, content, words)


def _of_two_bytes(content: bytes) -> str | None:
    """Return the encoding of text in UTF-16 without a byte-order mark, whose every other byte is zero."""
    head = content[:_LOOKED_AT]
    odd, even = (head[start::2].count(0) / max(len(head) // 2, 1) for start in (1, 0))
    if max(odd, even) < _ZEROS or min(odd, even) > 0.01:
        return None
    return "utf-16-le" if odd > even else "utf-16-be"


def _guessed(path: str, content: bytes, words: Sequence[str]) -> tuple[str, str]:
    texts = {}
    for name in _GUESSES:
        try:
            texts[name] = content.decode(name)
        except UnicodeDecodeError:
            continue
    if not texts:
        raise InvalidInput(
            f"{path} is neither UTF-8 nor in any encoding tried ({', '.join(_GUESSES)}): export the record as UTF-8, "
            "or name its encoding under encoding in the YAML file of --columns"
        )
    wanted = [word.casefold() for word in words if not word.isascii()]
    best = min(texts, key=lambda name: _oddity(name, texts[name][:_LOOKED_AT], wanted))
    return texts[best], f"read in the encoding {best} ({_GUESSES[best][0]}), which was guessed"


def _oddity(name: str, text: str, wanted: Sequence[str]) -> tuple[int, float]:
    """Return what speaks against an encoding: headings that are missing, and the share of odd characters."""
    letters = odd = 0
    for word in _WORDS.findall(text.translate(dict.fromkeys(map(ord, _SYMBOLS), " "))):
        strange = [one for one in word if not one.isascii()]
        # Western letters stand among plain ones; other scripts are not mixed with those, nor capitals in words.
        mixed = len(strange) < len(word)
        wrong = mixed != (name == "cp1252") and len(word) > 1
        letters += len(strange)
        odd += len(strange) if wrong or _CAMEL.search(word) else sum(not _usual(name, one) for one in strange)
    others = [one for one in text if not one.isascii() and not one.isalnum() and one not in _SYMBOLS]
    odd += sum(not _usual(name, one) for one in others)
    return -sum(word in text.casefold() for word in wanted), odd / max(letters + len(others), 1)


def _usual(name: str, letter: str) -> bool:
    """Return whether a character is a common one of the script that an encoding is for."""
    common = _GUESSES[name][1]
    if common is None:
        script = unicodedata.name(letter, "").split(" ")[0]
        return script == {"cp1252": "LATIN", "cp1251": "CYRILLIC"}[name]
    try:
        code = letter.encode(common)
    except UnicodeEncodeError:
        return False
    return len(code) == 2 and (not unicodedata.name(letter, "").startswith("CJK") or code[0] <= _DAILY[common])
