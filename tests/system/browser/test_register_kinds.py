"""The page takes registers of every kind: maps of the conformance cases, opened, written and clicked."""

from dataclasses import replace
from pathlib import Path

import pytest

from ...conformance.suite import cases, diagnose, whole_map  # noqa: TID252 (tests are no package)
from .pages import Opener
from .register_pages import written

pytestmark = pytest.mark.browser

EVERY = 25
"""Of so many cases one is taken; cases of a kind stand together."""

TRY_ALL = """() => {
  document.querySelector('#more button')?.click()
  const links = [...document.querySelectorAll('#results .row')].map((row) => row.hash.slice(1))
  const odd = []
  for (const link of links) {
    history.replaceState(null, '', `#q=nothing&${link.includes('=') ? link : `open=${link}`}`)
    dispatchEvent(new Event('popstate'))
    for (const text of ['1', '-1.5', 'abc']) {
      const field = document.querySelector('[data-value=text]')
      if (!field) break
      field.value = text
      field.dispatchEvent(new Event('input'))
    }
    document.querySelector('[data-bit]')?.click()
    const shown = document.querySelector('.calculator')?.innerText ?? ''
    if (!document.querySelector('#details .title') || /undefined|NaN|\\[object/.test(shown)) odd.push(link)
  }
  return [links.length, odd]
}"""


def test_registers_of_every_kind_open_and_calculate(open_page: Opener, tmp_path: Path) -> None:
    compiled = (diagnose(whole_map(case.map))[0] for case in list(cases())[::EVERY])
    maps = [replace(one, id=f"cases/{place}") for place, one in enumerate(compiled) if one]
    count, odd = open_page(written(tmp_path, *maps)).evaluate(TRY_ALL)
    assert odd == []
    assert count > len(maps) > 30
