// A module or a group: what it is, what can be done with it, its parameters, ports and times.

import { html } from 'htm/preact';
import { IsGroup, ThreadOf } from '../model/structure.js';
import { FormatMicroseconds } from '../model/value_format.js';
import { PauseElement, Reload, ResumeElement, SetLogLevel, SetTags } from '../state/actions.js';
import { AlarmCount, AlarmsAt } from '../state/alarms.js';
import { DeleteCarefully } from '../state/careful.js';
import { IsOpen, openDialog } from '../state/choices.js';
import { canChange, catalogue, profile, revision, run, structure } from '../state/store.js';
import { ThreadColour } from '../graph/thread_colour.js';
import { ToggleGroup } from '../graph/graph_state.js';
import { AlarmList } from './alarms.js';
import { ParameterRow } from './parameter_row.js';
import { DrawingPicture } from './drawing_picture.js';
import { ImagePicture } from './image_picture.js';
import { ActionButton, Facts, Link, Section, Title } from './parts.js';
import { NoteLine } from './note_line.js';
import { PortRow } from './port_row.js';
import { Troubles } from './troubles.js';

export function ModuleDetails({ element }) {
  revision.value;
  const { path } = element;
  const isGroup = IsGroup(element);
  const parameters = structure.parametersOf(path);
  const ports = structure.portsOf(path);
  const members = isGroup ? structure.membersOf(path) : [];
  const plugin = catalogue.value.module(element.type)?.plugin;
  const thread = ThreadOf(structure, path);
  const open = (kind) => () => { openDialog.value = { kind, path }; };
  const locked = !canChange.value;
  return html`
    <${Title} kind=${isGroup ? 'group' : element.type} name=${element.name} path=${path}>
      ${(element.summary || element.description) && html`<p class="summary">${element.summary || element.description}</p>`}
      <${NoteLine} path=${path} /><//>
    ${element.failure && html`<p class="trouble" role="alert"><strong>Fault:</strong> ${element.failure}</p>`}
    <${AlarmList} path=${path} />
    <div class="actions">
      ${!isGroup && html`<${ActionButton} id="swap" icon="swap" text="Swap" disabled=${locked}
          onClick=${open('swap')} title="Put a module of another type in its place (S)" />`}
      ${isGroup && html`<${ActionButton} id="fold" icon="layers" text=${IsOpen(path) ? 'Fold' : 'Open'}
          onClick=${() => ToggleGroup(path)} />
        <${ActionButton} id="add-port" icon="add" text="Port" disabled=${locked} onClick=${open('port')}
            title="Give it a port for others" />`}
      <${ActionButton} id="move" icon="follow" text="Thread" disabled=${locked} onClick=${open('move')}
          title="Have another thread run it (M)" />
      <${ActionButton} id="pause-module" icon="pause" text=${element.paused ? 'Go on' : 'Pause'} disabled=${locked}
          onClick=${() => (element.paused ? ResumeElement(path) : PauseElement(path))}
          title="Leave it out of cycles for a while" />
      ${plugin && html`<${ActionButton} id="reload" icon="reset" text="Reload" disabled=${locked}
          onClick=${() => Reload(plugin)}
        title=${`Load the plugin ${plugin} anew, with all its modules`} />`}
      <${ActionButton} id="delete" icon="trash" text="Delete" disabled=${locked} onClick=${() => DeleteCarefully([path])} />
    </div>
    <${Facts} facts=${[
      ['thread', thread && html`<span class="thread-name"><i
          style=${{ background: ThreadColour(thread) }}></i>${thread}${
        element.thread ? '' : html` <small>of its group</small>`}</span>`],
      ['plugin', plugin], ['tags', html`<${Tags} key=${`${path} ${element.tags ?? ''}`} path=${path} tags=${element.tags ?? ''} />`],
      ...profile.value.tasks.filter((task) => task.path === path).map((task) => [`takes${task.name.slice(path.length)}`,
        `${FormatMicroseconds(task.last_us)} last, ${FormatMicroseconds(task.mean_us)} mean, at most ${
          FormatMicroseconds(task.max_us)}; runs as number ${task.order} of its thread`]),
      ['logs', html`<${LogLevel} path=${path} />`],
    ]} />
    <${Troubles} path=${path} />
    ${parameters.length > 0 && html`<${Section} title="Parameters" count=${parameters.length} id="parameters">
      ${parameters.map((parameter) => html`<${ParameterRow} key=${parameter.path} parameter=${parameter} />`)}<//>`}
    ${ports.filter((port) => port.direction === 'output' && catalogue.value.meaning(port.data_type) === 'drawing')
      .map((port) => html`<${DrawingPicture} key=${port.path} path=${port.path} />`)}
    ${ports.filter((port) => port.direction === 'output' && catalogue.value.meaning(port.data_type) === 'image')
      .map((port) => html`<${ImagePicture} key=${port.path} path=${port.path} />`)}
    ${['input', 'output'].map((direction) => {
      const some = ports.filter((port) => port.direction === direction);
      return some.length > 0 && html`<${Section} title=${`${direction === 'input' ? 'Inputs' : 'Outputs'}`}
          count=${some.length} key=${direction}>
        <ul class="ports">${some.map((port) => html`<${PortRow} key=${port.path} port=${port} />`)}</ul><//>`;
    })}
    ${members.length > 0 && html`<${Section} title="Contains" count=${members.length}>
      <ul class="members">${members.slice(0, 200).map((member) => html`<li key=${member}><${Link} path=${member} />
        <small>${structure.get(member).type ?? 'group'}</small>
        ${AlarmCount(member) > 0 && html`<span class="badge bad">${AlarmsAt(member).map(({ kind }) => kAlarmWords[kind]).join(', ')}</span>`}</li>`)}</ul><//>`}`;
}

const kAlarmWords = { failed: 'failed', unconnected: 'without a source', silent: 'silent', stuck: 'stuck' };

/** Words for whoever looks at it, separated by blanks: Enter sets them. */
function Tags({ path, tags }) {
  const onKey = (event) => {
    if (event.key === 'Enter' && event.target.value.trim() !== tags) SetTags(path, event.target.value.trim());
    else if (event.key === 'Escape') { event.target.value = tags; event.target.blur(); } else if (event.key !== 'Enter') return;
    event.stopPropagation();
  };
  return html`<input id="tags" class="tags" aria-label="Tags" autocomplete="off" spellcheck="false" disabled=${!canChange.value}
    placeholder="none" value=${tags} onKeyDown=${onKey} onBlur=${(event) => { event.target.value = tags; }} />`;
}

const kLogLevels = { inherit: 'as around it', debug: 'debug and more', info: 'info and more',
  warning: 'warnings and errors', error: 'errors', off: 'nothing' };

/** From which level on is logged what the module, or those in the group, say. */
function LogLevel({ path }) {
  const level = run.value.log_levels[path] ?? 'inherit';
  return html`<select id="log-level" aria-label="Log" value=${level} disabled=${!canChange.value}
      onChange=${(event) => SetLogLevel(path, event.target.value)}>
    ${Object.entries(kLogLevels).map(([name, text]) => html`<option key=${name} value=${name}>${text}</option>`)}</select>`;
}
