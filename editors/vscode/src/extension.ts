// The client of `regscribe lsp`: it starts the program for maps, and says what to do where it is missing.

import { isAbsolute, join } from "node:path";
import { commands, type ExtensionContext, window, workspace } from "vscode";
import { LanguageClient } from "vscode-languageclient/node";

const SECTION = "regscribe";
const SETTINGS = "Open Settings";

let client: LanguageClient | undefined;

/** Start the server, and start it anew when the user asks or changes what is started. */
export async function activate(context: ExtensionContext): Promise<void> {
  context.subscriptions.push(
    commands.registerCommand("regscribe.restart", restart),
    workspace.onDidChangeConfiguration(async (change) => {
      if (change.affectsConfiguration("regscribe.command") || change.affectsConfiguration("regscribe.maps")) {
        await restart();
      }
    }),
  );
  await start();
}

/** Stop the server. */
export async function deactivate(): Promise<void> {
  const stopped = client;
  client = undefined;
  if (stopped?.isRunning()) {
    await stopped.stop();
  }
}

async function restart(): Promise<void> {
  await deactivate();
  await start();
}

async function start(): Promise<void> {
  const settings = workspace.getConfiguration(SECTION);
  const [program = SECTION, ...args] = settings.get<string[]>("command", []);
  const folder = workspace.workspaceFolders?.[0]?.uri.fsPath;
  const command = found(program, folder);
  client = new LanguageClient(
    SECTION,
    "regscribe",
    { command, args, options: folder === undefined ? {} : { cwd: folder } },
    {
      documentSelector: settings.get<string[]>("maps", []).map((pattern) => ({ scheme: "file", pattern })),
      synchronize: { configurationSection: SECTION },
    },
  );
  try {
    await client.start();
  } catch (error) {
    await tell(command, error);
  }
}

/** The path of a program: one with a folder in it counts from the first folder of the workspace. */
function found(program: string, folder: string | undefined): string {
  const inFolder = /[\\/]/.test(program) && !isAbsolute(program) && folder !== undefined;
  return inFolder ? join(folder, program) : program;
}

async function tell(command: string, error: unknown): Promise<void> {
  const reason = error instanceof Error ? error.message : String(error);
  const advice = "Install it (pip install 'regscribe[lsp]'), or name it in the setting regscribe.command.";
  const chosen = await window.showErrorMessage(`${command} could not be started: ${reason}. ${advice}`, SETTINGS);
  if (chosen === SETTINGS) {
    await commands.executeCommand("workbench.action.openSettings", "regscribe.command");
  }
}
