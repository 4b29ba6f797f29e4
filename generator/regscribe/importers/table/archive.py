"""Looks into a workbook before it is read: whether it is one, and whether it unpacks to a bearable size."""

import io
import zipfile

from regscribe.importers.table.grid import TableError

ZIP = b"PK\x03\x04"
OLE = b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1"
"""What begins an old workbook (.xls), and one that is encrypted."""

ENCRYPTED = "EncryptedPackage".encode("utf-16-le")

MOST_UNPACKED = 256 * 1024 * 1024
MOST_PACKED = 100
"""A part that is larger than `LARGE` and was packed more than so many times is made to fill the memory."""
LARGE = 16 * 1024 * 1024
MOST_PARTS = 5_000


def is_workbook(data: bytes) -> bool:
    """Whether bytes may be a workbook, a broken or an old one too."""
    return data.startswith((ZIP, OLE))


def opened(data: bytes, name: str) -> zipfile.ZipFile:
    """Open a workbook of the kind .xlsx or .xlsm. Raises TableError, before anything large is unpacked."""
    if data.startswith(OLE):
        if ENCRYPTED in data:
            message = f"{name} is protected by a password: open it, save it without one, and import that"
        else:
            message = f"{name} is a workbook of the old kind (.xls): open it and save it as .xlsx"
        raise TableError(message)
    try:
        archive = zipfile.ZipFile(io.BytesIO(data))
        parts = archive.infolist()
    except (zipfile.BadZipFile, ValueError, NotImplementedError, OSError) as error:
        message = f"{name} is a broken workbook ({error}): copy or save it anew"
        raise TableError(message) from None
    _check(parts, name)
    names = {part.filename for part in parts}
    if "xl/workbook.xml" not in names:
        other = "a spreadsheet of another kind (.ods)" if "content.xml" in names else "an archive and no workbook"
        message = f"{name} is {other}: save the table as .xlsx or as CSV"
        raise TableError(message)
    return archive


def _check(parts: list[zipfile.ZipInfo], name: str) -> None:
    """Raise TableError for what would fill the memory, by the sizes that the archive tells (no more is unpacked)."""
    if len(parts) > MOST_PARTS:
        message = f"{name} has {len(parts)} parts, more than the {MOST_PARTS} that a workbook may have"
        raise TableError(message)
    whole = sum(part.file_size for part in parts)
    if whole > MOST_UNPACKED:
        message = (
            f"{name} would unpack to {whole} bytes, more than the {MOST_UNPACKED} that are read: save the sheet alone"
        )
        raise TableError(message)
    for part in parts:
        if part.file_size > max(LARGE, part.compress_size * MOST_PACKED):
            message = (
                f"{name}: its part {part.filename} has {part.compress_size} bytes and would unpack to "
                f"{part.file_size}: no workbook of a list of registers does; save the sheet as CSV"
            )
            raise TableError(message)
        if part.flag_bits & 1:
            message = f"{name} is protected by a password: open it, save it without one, and import that"
            raise TableError(message)
