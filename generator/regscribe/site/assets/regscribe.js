// Tables that scroll can be reached and scrolled by the keyboard; the theme wraps them while the page loads.
addEventListener("load", () => {
  for (const wrapper of document.querySelectorAll(".md-typeset__scrollwrap")) wrapper.tabIndex = 0
})
