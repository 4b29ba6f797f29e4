/**
 * The page: its state is in its address; what is chosen in a calculator is not.
 */

const browser = {
  maps: [],
  items: [],
  book: new Map(),
  searched: null, // the last query with what it found
  state: { query: "", chosen: {}, open: "", map: "", element: "" },
  open: null,
  opened: new Set(matchMedia("(min-width: 1101px)").matches ? ["model", "access"] : []),
  said: new Map(),
  choices: new Map(),
  most: MOST_ROWS,
  calculates: true,
}

/** Open the data and show what the address says. */
function start() {
  browser.maps = open(JSON.parse(document.getElementById("data").textContent))
  browser.items = indexOf(browser.maps)
  browser.book = addressBook(browser.items)
  listen()
  browser.state = readHash(location.hash)
  document.getElementById("search").value = browser.state.query
  render()
  if (browser.open) reveal()
}

function listen() {
  const field = document.getElementById("search")
  field.addEventListener("input", () => go({ ...browser.state, query: field.value }, true))
  document.getElementById("theme").addEventListener("click", changeTheme)
  document.addEventListener("keydown", onKey)
  window.addEventListener("popstate", follow)
  window.addEventListener("hashchange", follow)
  window.addEventListener("beforeprint", openAll)
  window.addEventListener("afterprint", render)
}

/** Show what the address of the page says: after a link, Back or Forward. */
function follow() {
  const state = readHash(location.hash)
  if (writeHash(state) === writeHash(browser.state)) return
  const isOther = ["open", "map", "element"].some((name) => state[name] !== browser.state[name])
  browser.state = state
  const field = document.getElementById("search")
  if (field.value !== state.query) field.value = state.query
  render()
  if (isOther && browser.open) reveal()
}

/** Go to a state; typing replaces the last one, everything else can be undone by Back. */
function go(state, isTyping = false) {
  browser.most = MOST_ROWS
  browser.state = state
  history[isTyping ? "replaceState" : "pushState"](null, "", writeHash(state))
  render()
}

/** Close what is open; the focus goes back to its row. */
function close() {
  const row = document.querySelector('#results [aria-current="true"]')
  const href = row?.getAttribute("href")
  go({ ...browser.state, open: "", map: "", element: "" })
  const again = [...document.querySelectorAll("#results .row")].find((one) =>
    one.getAttribute("href")?.endsWith(href?.split("open=").pop() ?? "\n"),
  )
  ;(again ?? document.getElementById("search")).focus()
}

/** Put the focus on what was opened, or on the part of it that a link leads to. */
function reveal() {
  document.querySelector('#results [aria-current="true"]')?.scrollIntoView({ block: "nearest" })
  const target = document.getElementById(browser.state.open)
  const isPart = target && target.classList.contains("target")
  const heading = isPart ? target : document.getElementById("opened")
  heading?.focus({ preventScroll: !isPart })
  if (isPart) target.scrollIntoView()
  else document.getElementById("details").scrollTop = 0
}

function onKey(event) {
  const isField = /^(?:INPUT|SELECT|TEXTAREA)$/.test(event.target.tagName)
  if (event.key === "/" && !isField) {
    event.preventDefault()
    const field = document.getElementById("search")
    field.focus()
    field.select()
  } else if (event.key === "Escape" && browser.open) {
    event.preventDefault()
    close()
  } else if (event.key === "Enter" && event.target.id === "search") {
    document.querySelector("#results .row")?.click()
  } else moveFocus(event)
}

/** Light or dark: what the system prefers, until the button was used. */
function changeTheme() {
  const isDark = document.documentElement.dataset.theme
    ? document.documentElement.dataset.theme === "dark"
    : matchMedia("(prefers-color-scheme: dark)").matches
  document.documentElement.dataset.theme = isDark ? "light" : "dark"
  announce(isDark ? "Light" : "Dark")
}

document.addEventListener("DOMContentLoaded", start)
