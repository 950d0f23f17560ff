// The dialog that is open, if one is.

import { useEffect, useErrorBoundary } from 'preact/hooks';
import { html } from 'htm/preact';
import { openDialog } from '../state/choices.js';
import { revision, structure } from '../state/store.js';
import { Toast } from '../state/toasts.js';
import { ConfirmDialog } from './confirm_dialog.js';
import { ConnectDialog } from './connect_dialog.js';
import { ConvertDialog } from './convert_dialog.js';
import { CreateDialog } from './create_dialog.js';
import { CloseDialog } from './dialog.js';
import { Menu } from './menu.js';
import { NoteDialog } from './note_dialog.js';
import { OfferDialog } from './offer_dialog.js';
import { PortDialog } from './port_dialog.js';
import { RenameDialog } from './rename_dialog.js';
import { HelpDialog, MoveDialog, SaveDialog } from './small_dialogs.js';
import { SaveDifference } from './save_difference.js';
import { submitting } from './submission.js';
import { SwapDialog } from './swap_dialog.js';
import { TakeDialog } from './take_dialog.js';

const kDialogs = {
  confirm: ConfirmDialog, create: CreateDialog, connect: ConnectDialog, convert: ConvertDialog, swap: SwapDialog, move: MoveDialog, port: PortDialog,
  difference: SaveDifference, save: SaveDialog, help: HelpDialog, menu: Menu, note: NoteDialog, offer: OfferDialog, rename: RenameDialog, take: TakeDialog,
};

/** What a dialog is about and nobody has any more: another viewer has taken it away. Who has asked for that waits for the answer. */
function Gone(open) {
  if (!open || open.kind === 'confirm' || submitting.value === open) return undefined;
  return [open.path, open.group, open.from, open.to].find((path) => path && !structure.get(path) && !structure.connections.has(path));
}

export function OpenDialog() {
  revision.value;
  const open = openDialog.value;
  const [error, again] = useErrorBoundary((thrown) => console.error('The dialog cannot be drawn:', thrown));
  const gone = Gone(open);
  useEffect(() => {
    if (!error && !gone) return;
    if (error) Toast('error', 'The dialog cannot be drawn', [String(error.message ?? error)]);
    else Toast('refused', `${gone} is gone`, ['The dialog about it has been closed.']);
    CloseDialog(open);
    if (error) again();
  }, [error, gone]);
  return open && !error && !gone ? html`<${kDialogs[open.kind]} key=${`${open.kind} ${open.path ?? ''}`} ...${open} />` : null;
}
