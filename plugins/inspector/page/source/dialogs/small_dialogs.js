// Choosing a thread, a file's name; the list of keys.

import { useState } from 'preact/hooks';
import { html } from 'htm/preact';
import { IsGroup } from '../model/structure.js';
import { MoveToThread, Save, SaveConfiguration } from '../state/actions.js';
import { hello, structure } from '../state/store.js';
import { ChoiceList } from './choice_list.js';
import { CloseDialog, Dialog } from './dialog.js';
import { useSubmission } from './submission.js';

export function MoveDialog({ path }) {
  const element = structure.get(path);
  const entries = [...structure.ofKind('thread')].map((thread) => ({
    key: thread.name, title: thread.name, note: thread.period ? `every ${thread.period * 1000} ms` : 'by data',
  }));
  if (!IsGroup(element) || element.thread) entries.push({ key: '', title: 'that of its group', note: 'no thread of its own' });
  const find = (text) => entries.filter((entry) => entry.title.includes(text.trim()));
  return html`
    <${Dialog} title=${`Thread of ${element.name}`}>
      <h2>Which thread shall run ${element.name}?</h2>
      <${ChoiceList} label="Threads" placeholder="Thread" find=${find}
        onChoose=${(entry) => { CloseDialog(); MoveToThread(path, entry.key); }} />
    <//>`;
}

export function SaveDialog() {
  const [file, setFile] = useState(hello.value?.file ?? '');
  const [taken, setTaken] = useState(''); // the file of which the user has been told that it is there
  const name = file.trim();
  const { button, onEnter, problem, clear } = useSubmission({
    failed: 'Could not save', may: (what) => what === 'values' || name !== '',
    send: async (what) => {
      if (what === 'values') return SaveConfiguration({ quiet: true });
      const reply = await Save(name, { quiet: true, overwrite: what === 'overwrite' });
      setTaken(reply.needs === 'overwrite' ? name : '');
      return reply;
    },
  });
  return html`
    <${Dialog} title="Save as">
      <h2>Save the application as</h2>
      <input id="save-file" class="wide-input" aria-label="File" value=${file} spellcheck="false" autofocus
        onInput=${(event) => { setFile(event.target.value); clear(); }} onKeyDown=${onEnter()} />
      <p class="note">A file on the machine that runs the application.</p>
      ${problem}
      <div class="dialog-foot"><button onClick=${() => CloseDialog()}>Cancel</button>
        <button id="save-configuration" ...${button('values')}
          title="Values of parameters, back into the configuration that it was loaded with">Values into configuration</button>
        ${taken !== '' && taken === name && html`<button class="danger" id="save-overwrite" ...${button('overwrite')}>Overwrite</button>`}
        <button class="primary" id="save-now" ...${button()}>Save</button></div>
    <//>`;
}

const kKeys = [
  ['In the graph', [
    ['← ↑ → ↓', 'to the next module in that direction'], ['Shift + arrows', 'along the ports of a module'],
    ['Enter, Space', 'open or fold a group'], ['C', 'connect the selected port'], ['S', 'swap the module'],
    ['M', 'move to another thread'], ['N', 'write a note'], ['F2', 'rename'], ['Shift + click, drag', 'choose several'], ['Delete', 'delete or disconnect'], ['Shift + F10', 'menu'],
    ['F', 'fit'], ['+ −', 'zoom'], ['Escape', 'select nothing'],
  ]],
  ['Everywhere', [
    ['/', 'find'], ['A', 'add a module'], ['Ctrl + Z', 'undo'], ['Ctrl + Shift + Z, Ctrl + Y', 'redo'], ['Ctrl + S', 'save'], ['Ctrl + C, Ctrl + V', 'copy, paste'],
    ['Ctrl + Space, Pause', 'STOP: all that moves gets its safe value'], ['P', 'pause or go on'], ['.', 'one step'], ['G', 'to the graph'], ['D', 'to the details'], ['?', 'this list'],
  ]],
];

export function HelpDialog() {
  return html`
    <${Dialog} title="Keys" className="wide help">
      <h2>Keys</h2>
      <div class="columns">${kKeys.map(([title, keys]) => html`<section key=${title}><h3>${title}</h3>
        <dl>${keys.map(([key, what]) => html`<div key=${key}><dt><kbd>${key}</kbd></dt><dd>${what}</dd></div>`)}</dl></section>`)}</div>
      <p class="note">Drag from port to port to connect; drag a box to move it, the background to move all, turn the wheel to zoom; right-click for a menu.</p>
      <div class="dialog-foot"><button class="primary" onClick=${() => CloseDialog()}>Close</button></div>
    <//>`;
}
