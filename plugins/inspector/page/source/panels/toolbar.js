// The bar on top: the application, its time and pace, changes, and how the page looks.

import { useEffect, useState } from 'preact/hooks';
import { html } from 'htm/preact';
import { FormatTime } from '../model/value_format.js';
import { Pause, Redo, Resume, SetSpeed, Step, Undo, WhoseChange } from '../state/actions.js';
import { GroupForNew, SetPanels, openDialog, panels, theme } from '../state/choices.js';
import { canChange, canDrive, connection, hello, isConnected, isSilent, refusals, role, run } from '../state/store.js';
import { isNarrow, isPhone } from '../state/window.js';
import { hasWorld } from '../world/world_view.js';
import { AlarmCounter } from './alarms.js';
import { Icon } from './icon.js';
import { SearchBox } from './search_box.js';

const kSpeeds = [0.1, 0.25, 0.5, 1, 2, 5, 10, 20, 50, 100, 0];

const kRoleTitles = {
  look: 'This page may look, and change nothing',
  drive: 'This page may set values by hand, pause and go on, and change nothing else',
};

export function Toolbar() {
  return html`
    <header class="toolbar" role="toolbar" aria-label="Application">
      <div class="brand"><${Icon} name="mark" /><h1>${hello.value?.application ?? 'Runnel'}</h1>
        <${ConnectionState} /></div>
      <${Pace} />
      <${Changes} />
      <${SearchBox} />
      <div class="spring"></div>
      <${Looks} />
    </header>`;
}

function ConnectionState() {
  const { state } = connection.value;
  const { ended, verdict } = run.value;
  const [kind, text] = isConnected.value ? (ended ? ['ended', verdict ?? 'ended'] : ['good', 'connected'])
    : state === 'connecting' && !hello.value ? ['wait', 'connecting'] : ['bad', isSilent.value ? 'silent' : 'disconnected'];
  return html`<span class=${`state ${kind}`} role="status" id="connection-state"
      title=${hello.value ? `${hello.value.file}, Runnel ${hello.value.runnel}` : ''}>${text}</span>
    ${hello.value && role.value !== 'change' && html`<span class="state read-only" title=${kRoleTitles[role.value]}>${
      role.value === 'look' ? 'read-only' : role.value}</span>`}`;
}

function Pace() {
  const { time, paused, speed, ended } = run.value;
  const isSimulated = hello.value?.clock === 'simulated';
  const locked = !canChange.value || ended;
  const [cycles, setCycles] = useState(1);
  if (!hello.value) return null;
  return html`
    <div class="cluster" role="group" aria-label="Time">
      <output class="time" aria-label="Time of the application" id="time">${FormatTime(time)}</output>
      ${isSimulated && html`
        <button class="primary-icon" id="pause" disabled=${!canDrive.value || ended} aria-pressed=${paused}
          onClick=${() => (paused ? Resume() : Pause())}
          title=${paused ? 'Go on (Space outside the graph)' : 'Pause'} aria-label=${paused ? 'Go on' : 'Pause'}>
          <${Icon} name=${paused ? 'play' : 'pause'} /></button>
        <span class="joined"><button id="step" disabled=${locked} onClick=${() => Step(cycles)}
            title="Run some cycles, then pause"
          aria-label=${`Step ${cycles} cycles`}><${Icon} name="step" /></button>
          <input type="number" id="step-cycles" min="1" max="100000" value=${cycles} disabled=${locked}
              aria-label="Cycles of a step"
            onInput=${(event) => setCycles(Math.max(1, Math.round(event.target.valueAsNumber) || 1))} /></span>
        <${Speed} speed=${speed} locked=${locked} />`}
    </div>`;
}

function Speed({ speed, locked }) {
  refusals.value;
  const known = speed === null || kSpeeds.includes(speed) ? kSpeeds : [...kSpeeds.slice(0, -1), speed, 0];
  return html`<select id="speed" disabled=${locked || speed === null} value=${speed ?? ''}
      aria-label="Speed of the simulation"
      title="Speed of the simulation" onChange=${(event) => SetSpeed(Number(event.target.value))}>
    ${known.map((value) => html`<option key=${value} value=${value} selected=${value === speed}>
      ${value === 0 ? 'as fast as it can' : `× ${value}`}</option>`)}
  </select>`;
}

function Changes() {
  const { undo, redo } = run.value;
  const whose = (client) => { const text = WhoseChange(client, hello.value?.viewer); return text ? `, ${text}` : ''; };
  const locked = !canChange.value;
  return html`
    <div class="cluster" role="group" aria-label="Changes">
      <button id="add" disabled=${locked} onClick=${() => { openDialog.value = { kind: 'create', group: GroupForNew() }; }}
        title="Add a module (A)" aria-label="Add a module"><${Icon} name="add" /></button>
      <button id="undo" disabled=${locked || !undo} onClick=${Undo}
          title=${undo ? `Undo “${undo}”${whose(run.value.undo_client)} (Ctrl+Z)` : 'Nothing to undo'}
        aria-label=${undo ? `Undo ${undo}` : 'Undo'}><${Icon} name="undo" /></button>
      <button id="redo" disabled=${locked || !redo} onClick=${Redo}
          title=${redo ? `Redo “${redo}”${whose(run.value.redo_client)} (Ctrl+Shift+Z)` : 'Nothing to redo'}
        aria-label=${redo ? `Redo ${redo}` : 'Redo'}><${Icon} name="redo" /></button>
      <span class="joined">
        <button id="save" disabled=${locked} onClick=${() => { openDialog.value = { kind: 'difference' }; }}
          title="Save into the application's file (Ctrl+S)"
          aria-label="Save"><${Icon} name="save" /></button>
        <button id="save-as" class="narrow" disabled=${locked}
            onClick=${() => { openDialog.value = { kind: 'save' }; }}
          title="Save as …" aria-label="Save as"><${Icon} name="more" /></button>
      </span>
    </div>`;
}

function Looks() {
  const faults = run.value.faults;
  const next = { system: 'light', light: 'dark', dark: 'system' }[theme.value];
  return html`
    <div class="cluster" role="group" aria-label="View">
      <${AlarmCounter} />
      ${faults > 0 && html`<button id="faults" class="faults" onClick=${() => SetPanels({ tab: 'log', dockOpen: true })}
        title="Faults since the start: see the log">${faults} fault${faults === 1 ? '' : 's'}</button>`}
      ${isNarrow.value && !isPhone.value && html`<button id="show-side" aria-pressed=${panels.value.sideOpen === true}
        onClick=${() => SetPanels({ sideOpen: !panels.value.sideOpen })} title="Map and details" aria-label="Map and details"><${Icon}
        name="panel" /></button>`}
      <button disabled=${!hasWorld.value} onClick=${() => SetPanels({ worldShown: !panels.value.worldShown, worldLarge: false })} id="show-world"
        aria-pressed=${panels.value.worldShown} title="World view" aria-label="World view"><${Icon}
        name="world" /></button>
      <a class="button-like" id="panel-link" href=${`/panel${location.search}`} title="The operator's panel: drive by hand, stop"
        aria-label="The operator's panel"><${Icon} name="drive" /></a>
      <button id="theme" onClick=${() => { theme.value = next; }} title=${`Colours: ${theme.value}; next: ${next}`}
        aria-label=${`Colours: ${theme.value}`}><${Icon} name=${theme.value} /></button>
      <button id="help" onClick=${() => { openDialog.value = { kind: 'help' }; }} title="Keys (?)"
          aria-label="Keys">?</button>
    </div>`;
}

/** A bar over the page while there is nobody at the other end. */
export function LostBanner() {
  const [isLong, setLong] = useState(false);
  const lost = !isConnected.value;
  useEffect(() => {
    if (!lost) return setLong(false);
    const timer = setTimeout(() => setLong(true), 400);
    return () => clearTimeout(timer);
  }, [lost]);
  if (!lost || !isLong || connection.value.state === 'refused') return null;
  const { ended, verdict } = run.value;
  return html`<div class=${`lost ${ended ? 'ended' : ''}`} role="alert" id="lost">
    ${!hello.value ? 'Trying to reach the application …'
      : ended ? `The application has ended${verdict ? `: ${verdict.trim().replace(/\.$/, '')}` : ''}. The page goes on when it is started again.`
      : isSilent.value ? 'The application has given no sign of life for 2 s or more: it hangs, or the network does. What you see is how it was last; whoever drove by this page drives no more.'
      : 'The application does not answer. What you see is how it was last. Trying to reach it again …'}</div>`;
}
