// The dialog that is open, if one is.

import { html } from 'htm/preact';
import { openDialog } from '../state/choices.js';
import { ConfirmDialog } from './confirm_dialog.js';
import { ConnectDialog } from './connect_dialog.js';
import { ConvertDialog } from './convert_dialog.js';
import { CreateDialog } from './create_dialog.js';
import { Menu } from './menu.js';
import { NoteDialog } from './note_dialog.js';
import { OfferDialog } from './offer_dialog.js';
import { PortDialog } from './port_dialog.js';
import { RenameDialog } from './rename_dialog.js';
import { HelpDialog, MoveDialog, SaveDialog } from './small_dialogs.js';
import { SaveDifference } from './save_difference.js';
import { SwapDialog } from './swap_dialog.js';
import { TakeDialog } from './take_dialog.js';

const kDialogs = {
  confirm: ConfirmDialog, create: CreateDialog, connect: ConnectDialog, convert: ConvertDialog, swap: SwapDialog, move: MoveDialog, port: PortDialog,
  difference: SaveDifference, save: SaveDialog, help: HelpDialog, menu: Menu, note: NoteDialog, offer: OfferDialog, rename: RenameDialog, take: TakeDialog,
};

export function OpenDialog() {
  const open = openDialog.value;
  return open ? html`<${kDialogs[open.kind]} key=${`${open.kind} ${open.path ?? ''}`} ...${open} />` : null;
}
