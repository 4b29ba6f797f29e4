// Stands in for the module `vscode`: what the client of the extension asks for is there, and what it tells is written as JSON lines.
//
//   node vscode_stub.cjs EXTENSION.js SETTINGS.json MAP.yaml
//
// The extension is activated with the settings; the map is open. It ends when the extension has told findings or an error.
"use strict";

const fs = require("node:fs");
const Module = require("node:module");
const path = require("node:path");

const [extension, settingsText, mapPath] = process.argv.slice(2);
const settings = JSON.parse(settingsText);
const tell = (event) => fs.writeSync(1, `${JSON.stringify(event)}\n`);

class Position { constructor(line, character) { Object.assign(this, { line, character }); } }
class Range {
  constructor(...ends) { // two positions, or four numbers
    const [start, end] = ends.length === 2 ? ends : [new Position(ends[0], ends[1]), new Position(ends[2], ends[3])];
    Object.assign(this, { start, end });
  }
}
class Diagnostic { constructor(range, message, severity) { Object.assign(this, { range, message, severity }); } }
class Uri {
  constructor(file) { Object.assign(this, { scheme: "file", path: file, fsPath: file }); }
  static file(file) { return new Uri(file); }
  static parse(text) { return new Uri(decodeURIComponent(text.replace("file://", ""))); }
  toString() { return `file://${this.path}`; }
}

/** Anything else: a class, a function, an event and a namespace at once, which does nothing. */
function anything(known = {}) {
  const nothing = class { dispose() {} };
  return new Proxy(Object.assign(nothing, known), {
    get: (target, name) => {
      if (name in target || typeof name === "symbol") { return target[name]; }
      return (target[name] = anything());
    },
    apply: () => ({ dispose() {} }),
  });
}

const disposable = () => ({ dispose() {} });
const folder = path.dirname(path.dirname(path.dirname(mapPath)));
const text = fs.readFileSync(mapPath, "utf8");
const document = {
  uri: Uri.file(mapPath), fileName: mapPath, languageId: "yaml", version: 1, isClosed: false, isDirty: false,
  getText: () => text,
};
const findings = (uri, found) => {
  if (found && found.length) { tell({ findings: found.map((one) => ({ message: one.message, line: one.range.start.line })) }); finish(); }
};
const vscode = anything({
  Position, Range, Diagnostic, Uri, version: "1.91.0",
  CancellationTokenSource: class { constructor() { this.token = { isCancellationRequested: false, onCancellationRequested: disposable }; } cancel() {} dispose() {} },
  CancellationError: Error, Disposable: class { dispose() {} static from() { return new this(); } },
  EventEmitter: class { constructor() { this.event = disposable; } fire() {} dispose() {} },
  DiagnosticSeverity: { Error: 0, Warning: 1, Information: 2, Hint: 3 },
  env: anything({ language: "en", appName: "stub", machineId: "stub", isTelemetryEnabled: false }),
  languages: anything({
    match: (selector, shown) => Number(shown === document),
    createDiagnosticCollection: () => ({ set: findings, delete() {}, clear() {}, has: () => false, dispose() {} }),
  }),
  workspace: anything({
    textDocuments: [document], workspaceFolders: [{ uri: Uri.file(folder), name: "stub", index: 0 }], notebookDocuments: [],
    getConfiguration: (section) => ({
      get: (key, otherwise) => (key in settings ? settings[key] : otherwise),
      ...(section === undefined ? { regscribe: settings } : settings), has: (key) => key in settings, inspect: () => undefined,
    }),
    asRelativePath: (file) => file,
  }),
  window: anything({
    visibleTextEditors: [], tabGroups: anything({ all: [] }),
    createOutputChannel: () => ({ append() {}, appendLine() {}, show() {}, clear() {}, replace() {}, dispose() {}, info() {}, warn() {}, error() {}, debug() {}, trace() {}, logLevel: 3, onDidChangeLogLevel: disposable }),
    showErrorMessage: async (message) => { tell({ error: message }); finish(); return undefined; },
    showInformationMessage: async () => undefined, showWarningMessage: async () => undefined,
  }),
});

const load = Module._load;
Module._load = (name, ...rest) => (name === "vscode" ? vscode : load(name, ...rest));

let active;
async function finish() {
  await new Promise((go) => setTimeout(go, 50)); // until the client has started, as it asks for its end
  await active?.deactivate();
  process.exit(0);
}

active = require(path.resolve(extension));
active.activate({ subscriptions: [], extensionPath: path.dirname(extension) }).then(() => tell({ active: true }));
