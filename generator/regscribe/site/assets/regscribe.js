// Tables that scroll can be reached and scrolled by the keyboard; the theme wraps them while the page loads.
addEventListener("load", () => {
  for (const wrapper of document.querySelectorAll(".md-typeset__scrollwrap")) wrapper.tabIndex = 0
})

// Long names in tables may end a line behind an underscore or a point: so wide tables fit. Copied text stays as it is.
addEventListener("load", () => {
  for (const name of document.querySelectorAll(".md-typeset td code")) {
    if (name.children.length) continue
    const [first, ...others] = name.textContent.split(/(?<=[_.])(?=\w)/)
    name.replaceChildren(first, ...others.flatMap((part) => [document.createElement("wbr"), part]))
  }
})
