// The menu of an element: what can be done with it.

import { html } from 'htm/preact';
import { CanBeDeleted, IsGroup, ParentOf } from '../model/structure.js';
import { IsFar } from '../model/network.js';
import { CreateGroup, Reload, RemoveOffer } from '../state/actions.js';
import { DeleteCarefully, DisconnectCarefully } from '../state/careful.js';
import { IsOpen, SetAllOpen, chosen, openDialog } from '../state/choices.js';
import { CopyChosen, DuplicateChosen, PasteCopied } from '../state/clipboard.js';
import { network } from '../state/network.js';
import { canChange, catalogue, structure } from '../state/store.js';
import { Fit, ToggleGroup } from '../graph/graph_state.js';
import { ArrangeAutomatically, IsArranged } from '../graph/move_boxes.js';
import { CloseDialog, Dialog } from './dialog.js';

export function Menu({ path, x, y }) {
  const items = MenuItems(path);
  const onKey = (event) => {
    const step = { ArrowDown: 1, ArrowUp: -1 }[event.key];
    if (!step) return;
    event.preventDefault();
    const buttons = [...event.currentTarget.querySelectorAll('button:not(:disabled)')];
    const at = buttons.indexOf(document.activeElement);
    buttons[(at + step + buttons.length) % buttons.length]?.focus();
  };
  // Neither over nor below the STOP, which is at the top, on phones at the bottom.
  const top = `clamp(48px, ${y}px, calc(100dvh - var(--stop-height) - ${items.length * 32 + 20}px))`;
  const style = { left: `${Math.min(x, innerWidth - 230)}px`, top };
  return html`
    <${Dialog} title="Menu" className="menu" style=${style}>
      <div role="menu" onKeyDown=${onKey}>
        ${items.map(({ text, action, changes, danger }) => html`
          <button key=${text} role="menuitem" class=${danger ? 'danger' : ''} disabled=${changes && !canChange.value}
            onClick=${() => { CloseDialog(); action(); }}>${text}</button>`)}
        ${items.length === 0 && html`<p class="none">nothing can be done with it here</p>`}
      </div>
    <//>`;
}

function MenuItems(path) {
  const connection = structure.connections.get(path);
  if (chosen.value.length > 1 && chosen.value.includes(path)) return ChosenItems();
  if (connection) {
    return [{ text: 'Note …', changes: true, action: () => { openDialog.value = { kind: 'note', path }; } },
      { text: 'Disconnect', changes: true, danger: true, action: () => DisconnectCarefully(connection.from, connection.to) }];
  }
  const element = structure.get(path);
  const open = (kind) => () => { openDialog.value = { kind, path }; };
  if (!element || (IsFar(element) && element.kind !== 'port')) return [];
  if (element.kind === 'port') {
    return [{ text: 'Connect …', changes: true, action: open('connect') },
      ...OfferItems(element, open),
      ...TakeItems(element, open),
      ...(CanBeDeleted(element) ? [{ text: 'Delete', changes: true, danger: true, action: () => DeleteCarefully([path]) }] : [])];
  }
  if (element.kind === 'module') return ModuleItems(element, open);
  return IsGroup(element) ? GroupItems(element, open) : [];
}

/** To other applications, of those that have a network. */
function OfferItems({ path, direction, far, offers, interface: isInterface }, open) {
  if (network.value === null || far || (direction === 'input' && !isInterface)) return [];
  return [{ text: 'Offer in the network …', changes: true, action: open('offer') },
    ...(offers ?? []).map(({ topic }) => ({ text: `Offer as ${topic} no more`, changes: true, action: () => RemoveOffer(path, topic) }))];
}

/** Of others, too. */
function TakeItems({ direction, far, interface: isInterface }, open) {
  if (network.value === null || far || (direction === 'output' && !isInterface)) return [];
  return [{ text: 'Take from the network …', changes: true, action: open('take') }];
}

function ChosenItems() {
  return [{ text: `Copy ${chosen.value.length} boxes`, action: CopyChosen },
    { text: 'Duplicate', changes: true, action: () => DuplicateChosen(ParentOf(chosen.value[0])) },
    { text: 'Delete', changes: true, danger: true, action: () => DeleteCarefully(chosen.value) }];
}

function ModuleItems({ path, type }, open) {
  const plugin = catalogue.value.module(type)?.plugin;
  return [
    { text: 'Swap …', changes: true, action: open('swap') },
    { text: 'Move to thread …', changes: true, action: open('move') },
    { text: 'Rename …', changes: true, action: open('rename') },
    { text: 'Note …', changes: true, action: open('note') },
    { text: 'Copy', action: CopyChosen },
    { text: 'Duplicate', changes: true, action: () => DuplicateChosen(ParentOf(path)) },
    ...(plugin ? [{ text: `Reload plugin ${plugin}`, changes: true, action: () => Reload(plugin) }] : []),
    { text: 'Delete', changes: true, danger: true, action: () => DeleteCarefully([path]) },
  ];
}

function GroupItems({ path }, open) {
  const isRoot = path === structure.root;
  return [
    { text: 'Add a module …', changes: true, action: () => { openDialog.value = { kind: 'create', group: path }; } },
    { text: 'New group', changes: true, action: () => CreateGroup(path) },
    { text: 'Paste', changes: true, action: () => PasteCopied(path) },
    ...(IsArranged(path) ? [{ text: 'Arrange automatically', changes: true, action: () => ArrangeAutomatically(path) }] : []),
    ...(isRoot ? [
      { text: 'Open all groups', action: () => SetAllOpen(true) },
      { text: 'Fold all groups', action: () => SetAllOpen(false) },
      { text: 'Fit', action: Fit },
    ] : [
      { text: IsOpen(path) ? 'Fold' : 'Open', action: () => ToggleGroup(path) },
      { text: 'Add a port …', changes: true, action: open('port') },
      { text: 'Move to thread …', changes: true, action: open('move') },
      { text: 'Rename …', changes: true, action: open('rename') },
      { text: 'Note …', changes: true, action: open('note') },
      { text: 'Copy', action: CopyChosen },
      { text: 'Duplicate', changes: true, action: () => DuplicateChosen(ParentOf(path)) },
      { text: 'Delete', changes: true, danger: true, action: () => DeleteCarefully([path]) },
    ]),
  ];
}
