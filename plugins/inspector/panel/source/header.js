// The bar on top: the application, its time, arranging and saving, the way to the inspector.

import { html } from 'htm/preact';
import { FormatTime } from '../../page/source/model/value_format.js';
import { Icon } from '../../page/source/panels/icon.js';
import { Pause, Resume } from '../../page/source/state/actions.js';
import { theme } from '../../page/source/state/choices.js';
import { canChange, canDrive, connection, hello, isConnected, isSilent, role, run } from '../../page/source/state/store.js';
import { KindIcon } from './editing/kind_icon.js';
import { Discard, SavePanel, chosen, file, isChanged, isEditing, isLoaded, isOverwriting, isUnsaved } from './panel_state.js';

export function Header() {
  return html`
    <header class="panel-head">
      <div class="brand"><${Icon} name="mark" /><h1>${hello.value?.application ?? 'Runnel'}</h1><${State} /></div>
      <${Time} />
      <span class="spring"></span>
      ${isLoaded.value && isEditing.value && html`<${Keeping} />`}
      <div class="cluster">
        ${isLoaded.value && html`<button id="edit" class="wide-only" aria-pressed=${isEditing.value} onClick=${ToggleEditing}
          title=${isEditing.value ? 'Done' : 'Arrange the panel'}><${KindIcon} name="edit" /><span>${isEditing.value ? 'Done' : 'Arrange'}</span></button>`}
        <a class="button-like" id="inspector" href=${`/${location.search}`} title="The inspector: data flow, parameters, log"><${Icon} name="plug" size=${17} /><span>Inspector</span></a>
        <${Theme} />
      </div>
    </header>`;
}

function ToggleEditing() {
  isEditing.value = !isEditing.value;
  chosen.value = null;
}

function State() {
  const { ended, verdict } = run.value;
  const [kind, text] = isConnected.value ? (ended ? ['ended', verdict ?? 'ended'] : ['good', 'connected'])
    : connection.value.state === 'connecting' && !hello.value ? ['wait', 'connecting'] : ['bad', isSilent.value ? 'silent' : 'disconnected'];
  return html`<span class=${`state ${kind}`} role="status" id="connection-state">${text}</span>
    ${hello.value && role.value !== 'change' && html`<span class="state read-only">${role.value === 'look' ? 'read-only' : 'drive'}</span>`}`;
}

function Time() {
  const { time, paused, ended } = run.value;
  if (!hello.value) return null;
  return html`<div class="cluster"><output class="time" id="time" aria-label="Time of the application">${FormatTime(time)}</output>
    ${hello.value.clock === 'simulated' && html`<button id="pause" disabled=${!canDrive.value || ended} aria-pressed=${paused} title=${paused ? 'Go on' : 'Pause'}
      aria-label=${paused ? 'Go on' : 'Pause'} onClick=${() => (paused ? Resume() : Pause())}><${Icon} name=${paused ? 'play' : 'pause'} /></button>`}</div>`;
}

/** Where the panel is kept, and whether it is. */
function Keeping() {
  const place = file.value ? `beside the application, in ${file.value}` : 'in memory, until the application ends: it came from no file';
  return html`
    <div class="cluster keeping"><span class="keeping-note" id="panel-state" title=${place}>${isChanged.value ? 'changed' : isUnsaved.value ? 'not saved' : 'saved'}${file.value ? '' : ', in memory'}</span>
      <button id="discard" disabled=${!isChanged.value && !isOverwriting.value} onClick=${Discard}>Discard</button>
      <button id="save-panel" class="primary" disabled=${!canChange.value || (!isChanged.value && !isUnsaved.value)} title=${`Keep it ${place}`} onClick=${SavePanel}>${isOverwriting.value ? 'Overwrite' : 'Save'}</button></div>`;
}

function Theme() {
  const next = { system: 'light', light: 'dark', dark: 'system' }[theme.value];
  return html`<button id="theme" onClick=${() => { theme.value = next; }} title=${`Colours: ${theme.value}; next: ${next}`}
    aria-label=${`Colours: ${theme.value}`}><${Icon} name=${theme.value} /></button>`;
}
