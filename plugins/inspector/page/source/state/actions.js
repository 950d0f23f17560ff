// What the user can ask of the application. Each returns the server's reply; what went wrong comes
// up as a toast, unless the caller shows it where it belongs.

import { Change, FreeName } from '../model/changes.js';
import { NameOf, ParentOf } from '../model/structure.js';
import { selected } from './choices.js';
import { Request, run, structure } from './store.js';
import { Toast } from './toasts.js';

/** One error as text, with its place and its cure. */
export function ErrorText(error) {
  const place = error.path && !error.message.includes(error.path) ? `${error.path}: ` : '';
  return `${place}${error.message}${error.hint ? `; ${error.hint}` : ''}`;
}

async function Ask(message, failed, { quiet = false } = {}) {
  const reply = await Request(message);
  if (!reply.ok && !quiet) Toast('error', failed, (reply.errors ?? []).map(ErrorText));
  return reply;
}

export function Apply(changes, label, options) {
  return Ask({ op: 'change', label, changes }, `Could not ${label}`, options);
}

export function SetParameter(path, value, options) {
  return Apply([Change.set(path, value)], `set ${NameOf(path)} to ${value}`, options);
}

export function PublishByHand(path, value, rate) {
  return Ask({ op: 'publish', path, value, ...(rate === null ? {} : { rate }) }, `Could not set ${Brief(path)}`, { quiet: true });
}
export const Release = (path) => Ask({ op: 'release', path }, `Could not release ${Brief(path)}`);

export async function Connect(from, to) {
  const reply = await Apply([Change.connect(from, to)], `connect ${Brief(from)} to ${Brief(to)}`);
  if (reply.ok) Toast('done', `Connected ${Brief(from)} to ${Brief(to)}`);
  return reply;
}

export function Disconnect(from, to) {
  return Apply([Change.disconnect(from, to)], `disconnect ${Brief(from)} from ${Brief(to)}`);
}

/** Whether a connection pulls is said when it is made, so it is made anew. */
export function SetPull(from, to, pull) {
  const { when_present, late } = structure.connectionsOf(from).find((each) => each.from === from && each.to === to) ?? {};
  return Apply([Change.disconnect(from, to), Change.connect(from, to, { pull, when_present, late })],
    `${pull ? 'pull' : 'push'} from ${Brief(from)} to ${Brief(to)}`);
}

export async function Delete(path) {
  const reply = await Apply([Change.delete(path)], `delete ${NameOf(path)}`);
  if (reply.ok && selected.value === path) selected.value = structure.get(path)?.owner ?? ParentOf(path);
  return reply;
}

/** `settings`: texts of parameters by their names. */
export function CreateModule(type, group, name, settings) {
  return Apply([Change.create(`${group}/${name}`, type, settings)], `create ${name}`, { quiet: true });
}

export function CreatePort(group, name, direction, type) {
  return Apply([Change.createPort(`${group}/${name}`, direction, type)], `create the ${direction} ${name}`, { quiet: true });
}

export function CreateGroup(group) {
  const path = `${group}/${FreeName(structure, group, 'group')}`;
  return Apply([Change.createGroup(path)], `create ${NameOf(path)}`);
}

export async function Swap(path, type, settings, options) {
  const reply = await Apply([Change.replace(path, type, settings)], `swap ${NameOf(path)} for ${type}`, options);
  if (reply.ok) Toast('done', `${NameOf(path)} is now ${type}`);
  return reply;
}

export function MoveToThread(path, thread) {
  return Apply([Change.move(path, thread)],
    thread ? `move ${NameOf(path)} to ${thread}` : `have ${NameOf(path)} run with its group`);
}

/** `level`: debug, info, warning, error, off, or inherit. */
export const SetLogLevel = (path, level) => Ask({ op: 'log_level', path, level }, `Could not set what ${NameOf(path)} logs`);
export const SetProfiled = (on) => Ask({ op: 'profile', on }, `Could not ${on ? 'begin' : 'end'} measuring`);
/** How old what comes of one output at another one is: measured, or no more. */
export const SetLatency = (from, to, on) => Ask({ op: 'latency', from, to, on }, `Could not ${on ? 'measure' : 'end measuring'} from ${Brief(from)} to ${Brief(to)}`);
/** Modules, or what a thread runs, are left out of cycles, or no more. */
export const PauseElement = (path) => Ask({ op: 'pause', path }, `Could not pause ${NameOf(path)}`);
export const ResumeElement = (path) => Ask({ op: 'resume', path }, `Could not let ${NameOf(path)} go on`);
/** `options`: { period, priority }, of which one may be left out; the period in seconds. */
export const Schedule = (path, options) => Apply([Change.schedule(path, options)], `schedule ${NameOf(path)}`);
export const CreateThread = (name, options) => Apply([Change.createThread(name, options)], `create thread ${name}`);
export const Undo = () => Ask({ op: 'undo' }, `Could not undo “${run.value.undo}”`);
export const Redo = () => Ask({ op: 'redo' }, `Could not redo “${run.value.redo}”`);
export const Pause = () => Ask({ op: 'pause' }, 'Could not pause');
export const Resume = () => Ask({ op: 'resume' }, 'Could not go on');
export const Step = (cycles) => Ask({ op: 'step', cycles }, 'Could not step');
export const SetSpeed = (speed) => Ask({ op: 'speed', speed }, 'Could not set the speed');
export const CompatibleTypes = (path) => Ask({ op: 'compatible', path }, 'Could not ask for other types');

/** What saving would make of the application's file: {file, before, after}. */
export const PreviewSave = (file = '') => Ask({ op: 'preview', file }, 'Could not tell what saving would change', { quiet: true });

export async function Save(file = '', options) {
  const reply = await Ask({ op: 'save', file }, 'Could not save', options);
  if (reply.ok) Toast('done', reply.text || 'Saved');
  return reply;
}

/** Values of parameters, back into the configuration that the application was loaded with. */
export async function SaveConfiguration(options) {
  const reply = await Ask({ op: 'save', what: 'configuration' }, 'Could not save the configuration', options);
  if (reply.ok) Toast('done', reply.text || 'Saved');
  return reply;
}

export async function Reload(plugin) {
  const reply = await Ask({ op: 'reload', plugin }, `Could not load ${plugin} anew`);
  if (reply.ok) Toast('done', reply.text || `${plugin} has been loaded anew`);
  return reply;
}

function Brief(path) {
  const port = structure.get(path);
  return port?.owner ? `${NameOf(port.owner)}/${port.name}` : path;
}
