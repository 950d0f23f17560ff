// The dialog that is open, if one is.

import { html } from 'htm/preact';
import { openDialog } from '../state/choices.js';
import { ConnectDialog } from './connect_dialog.js';
import { CreateDialog } from './create_dialog.js';
import { Menu } from './menu.js';
import { PortDialog } from './port_dialog.js';
import { HelpDialog, MoveDialog, SaveDialog } from './small_dialogs.js';
import { SaveDifference } from './save_difference.js';
import { SwapDialog } from './swap_dialog.js';

const kDialogs = {
  create: CreateDialog, connect: ConnectDialog, swap: SwapDialog, move: MoveDialog, port: PortDialog,
  difference: SaveDifference, save: SaveDialog, help: HelpDialog, menu: Menu,
};

export function OpenDialog() {
  const open = openDialog.value;
  return open ? html`<${kDialogs[open.kind]} key=${`${open.kind} ${open.path ?? ''}`} ...${open} />` : null;
}
