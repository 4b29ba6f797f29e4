"""Workbooks and PDFs as small as they can be, made on the fly."""

import io
from collections.abc import Callable, Sequence
from typing import Any

import openpyxl
import pytest
from openpyxl.workbook import Workbook


@pytest.fixture
def workbook() -> Callable[..., bytes]:
    """A workbook of sheets by name, each a list of rows; `change` gets it before it is saved."""

    def made(change: Callable[[Workbook], Any] | None = None, **sheets: Sequence[Sequence[Any]]) -> bytes:
        book = openpyxl.Workbook()
        book.remove(book.worksheets[0])
        for name, rows in sheets.items():
            sheet = book.create_sheet(name.replace("_", " "))
            for row in rows:
                sheet.append(list(row))
        if change is not None:
            change(book)
        data = io.BytesIO()
        book.save(data)
        return data.getvalue()

    return made


LEFT, TOP, WIDTH, HEIGHT = 50, 750, 90, 20


def _page(rows: Sequence[Sequence[str]]) -> str:
    """Drawing commands of a table with ruled lines."""
    columns = max(map(len, rows), default=0)
    right, bottom = LEFT + columns * WIDTH, TOP - len(rows) * HEIGHT
    lines = [f"{LEFT} {TOP - y * HEIGHT} m {right} {TOP - y * HEIGHT} l S" for y in range(len(rows) + 1) if rows]
    lines += [f"{LEFT + x * WIDTH} {TOP} m {LEFT + x * WIDTH} {bottom} l S" for x in range(columns + 1) if rows]
    for y, row in enumerate(rows):
        for x, text in enumerate(row):
            at = f"{LEFT + x * WIDTH + 4} {TOP - y * HEIGHT - 14}"
            lines.append(f"BT /F1 10 Tf {at} Td ({text}) Tj ET")
    return "\n".join(lines)


@pytest.fixture
def pdf() -> Callable[..., bytes]:
    """A PDF with one table a page; a page without rows has none. `more` goes into its trailer."""

    def made(*pages: Sequence[Sequence[str]], more: str = "") -> bytes:
        kids = " ".join(f"{4 + 2 * number} 0 R" for number in range(len(pages)))
        objects = [
            "<< /Type /Catalog /Pages 2 0 R >>",
            f"<< /Type /Pages /Kids [{kids}] /Count {len(pages)} >>",
            "<< /Type /Font /Subtype /Type1 /BaseFont /Helvetica >>",
        ]
        for number, rows in enumerate(pages):
            stream = _page(rows)
            resources = "/Resources << /Font << /F1 3 0 R >> >>"
            contents = f"/Contents {5 + 2 * number} 0 R"
            objects.append(f"<< /Type /Page /Parent 2 0 R /MediaBox [0 0 595 842] {resources} {contents} >>")
            objects.append(f"<< /Length {len(stream)} >>\nstream\n{stream}\nendstream")
        text, places = "%PDF-1.4\n", []
        for number, content in enumerate(objects, 1):
            places.append(len(text))
            text += f"{number} 0 obj\n{content}\nendobj\n"
        table = "".join(f"{place:010} 00000 n \n" for place in places)
        size = len(objects) + 1
        end = f"xref\n0 {size}\n0000000000 65535 f \n{table}trailer\n<< /Size {size} /Root 1 0 R {more} >>"
        return f"{text}{end}\nstartxref\n{len(text)}\n%%EOF\n".encode("latin-1")

    return made
