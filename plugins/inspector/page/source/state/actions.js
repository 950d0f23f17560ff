// What the user can ask of the application. Each returns the server's reply; what went wrong comes
// up as a toast, unless the caller shows it where it belongs.

import { Change, FreeName } from '../model/changes.js';
import { PasteChanges } from '../model/copies.js';
import { ConnectionKey, NameOf, ParentOf } from '../model/structure.js';
import { openGroups, selected } from './choices.js';
import { NoteEntries, Renamed, RenamedEntries, TakeArrangement } from './arrangement.js';
import { Request, hello, role, run, structure } from './store.js';
import { CloseDone, Toast } from './toasts.js';

/** One error as text, with its place and its cure. */
export function ErrorText(error) {
  const place = error.path && !error.message.includes(error.path) ? `${error.path}: ` : '';
  return `${place}${error.message}${error.hint ? `; ${error.hint}` : ''}`;
}

async function Ask(message, failed, { quiet = false } = {}) {
  // What is said of the change before would be taken for what is said of this one.
  if (['change', 'undo', 'redo'].includes(message.op)) CloseDone();
  const reply = await Request(message);
  if (!reply.ok && !quiet) Toast('error', failed, (reply.errors ?? []).map(ErrorText));
  return reply;
}

/** One change is called by the application what it is; several need a word for all of them. */
export function Apply(changes, label, options) {
  return Ask({ op: 'change', ...(changes.length > 1 ? { label } : {}), changes }, `Could not ${label}`, options);
}

export function SetParameter(path, value, options) {
  return Apply([Change.set(path, value)], `set ${NameOf(path)} to ${value}`, options);
}

export function PublishByHand(path, value, rate) {
  return Ask({ op: 'publish', path, value, ...(rate === null ? {} : { rate }) }, `Could not set ${Brief(path)}`, { quiet: true });
}
/** `value`: the arguments as a text. Its reply comes when the service has answered. */
export const CallService = (path, value) => Ask({ op: 'call', path, value }, `Could not call ${Brief(path)}`, { quiet: true });
export const AbortService = (path) => Ask({ op: 'abort', path }, `Could not abort ${Brief(path)}`);
export const Release = (path) => Ask({ op: 'release', path }, `Could not release ${Brief(path)}`);

/** As a connection names a part of a port's values: "/laser/scan.ranges[0]". */
const Part = (port, part) => (part ? `${port}${part.startsWith('[') ? '' : '.'}${part}` : port);

/** By which parts and conversions values of one port could be passed on to another. */
export const Conversions = (from, to) => Ask({ op: 'conversions', from, to }, '', { quiet: true });

/** `part`, `convert`: where the types are different. */
export async function Connect(from, to, { part = '', convert = '' } = {}) {
  const reply = await Apply([Change.connect(Part(from, part), to, convert === '' ? {} : { convert })], `connect ${Brief(from)} to ${Brief(to)}`);
  if (reply.ok) Toast('done', `Connected ${Brief(from)} to ${Brief(to)}`);
  return reply;
}

/** To others in the network; `settings`: as texts, by the words of <offer>. */
export const Offer = (path, settings) => Apply([Change.offer(path, settings)], `offer ${Brief(path)}`, { quiet: true });
/** What others write; `settings`: as texts, by the words of <take>. */
export const Take = (topic, path, settings) => Apply([Change.take(topic, path, settings)], `take ${topic}`, { quiet: true });
export const RemoveOffer = (path, topic) => Apply([Change.offer(path, { topic, remove: 'true' })], `offer ${Brief(path)} no more`);

export async function Disconnect(from, to) {
  const reply = await Apply([Change.disconnect(from, to)], `disconnect ${Brief(from)} from ${Brief(to)}`);
  if (reply.ok && selected.value === ConnectionKey({ from, to })) selected.value = null;
  return reply;
}

/** How a connection passes values on is said when it is made, so it is made anew, as it is now but for `options` and `part`. */
function Reconnect({ from, to, part }, options, label) {
  const { pull, convert, when_present, late, queue, on_full } = { ...structure.connections.get(ConnectionKey({ from, to })), ...options };
  const how = { pull, when_present, late, ...(convert ? { convert } : {}), ...(queue > 0 ? { queue, on_full } : {}) };
  return Apply([Change.disconnect(from, to), Change.connect(Part(from, part), to, how)], label);
}

export function SetPull(connection, pull) {
  return Reconnect(connection, { pull }, `${pull ? 'pull' : 'push'} from ${Brief(connection.from)} to ${Brief(connection.to)}`);
}

/** Another part of the values, or by another conversion. */
export function SetConversion(connection, { part, convert }) {
  return Reconnect({ ...connection, part }, { convert }, `convert ${Brief(Part(connection.from, part))} for ${Brief(connection.to)}`);
}

export function SetTags(path, tags) {
  return Apply([Change.tag(path, tags)], tags === '' ? `take away the tags of ${NameOf(path)}` : `tag ${NameOf(path)} ${tags}`);
}

/** `queue`: how many values wait, 0: only the newest is kept. */
export function SetQueue(connection, queue, on_full = 'drop_oldest') {
  return Reconnect(connection, { queue, on_full },
    `queue ${queue} values from ${Brief(connection.from)} to ${Brief(connection.to)}`);
}

export async function Delete(path) {
  const reply = await Apply([Change.delete(path)], `delete ${NameOf(path)}`);
  if (reply.ok && IsIn(selected.value, path)) selected.value = structure.get(path)?.owner ?? ParentOf(path);
  return reply;
}

export async function DeleteAll(paths) {
  const reply = await Apply(paths.map(Change.delete), `delete ${paths.map(NameOf).join(', ')}`);
  if (reply.ok && paths.some((path) => IsIn(selected.value, path))) selected.value = null;
  return reply;
}

const IsIn = (path, element) => path === element || (path !== null && path.startsWith(`${element}/`));

/** `settings`: texts of parameters by their names. */
export function CreateModule(type, group, name, settings) {
  return Apply([Change.create(`${group}/${name}`, type, settings)], `create ${name}`, { quiet: true });
}

/** Elements that have been copied, made again in a group; their paths, or null. */
export async function Paste(copy, group) {
  const { changes, paths } = PasteChanges(structure, copy, group);
  const reply = await Apply(changes, `paste ${paths.map(NameOf).join(', ')}`);
  return reply.ok ? paths : null;
}

/** Tells all viewers where boxes stand, or what is noted; it is kept beside the application's file. */
export async function Arrange(entries) {
  TakeArrangement(entries);
  if (role.value !== 'change') return;
  const reply = await Ask({ op: 'arrange', entries }, '', { quiet: true });
  if (!reply.ok) Toast('refused', 'The layout is kept by this page only', (reply.errors ?? []).map(ErrorText));
}

/** A note for all viewers, which is shown as the application tells it; of who may only look, for this page. */
export async function WriteNote(path, text) {
  const entries = NoteEntries(path, text);
  if (role.value === 'change') return Ask({ op: 'arrange', entries }, '', { quiet: true });
  TakeArrangement(entries);
  return { ok: true };
}

export async function Rename(path, name) {
  const reply = await Apply([Change.rename(path, name)], `rename ${NameOf(path)} to ${name}`, { quiet: true });
  if (reply.ok) Follow(path, `${ParentOf(path)}/${name}`);
  return reply;
}

/** What is arranged, selected and open goes with the name. */
function Follow(from, to) {
  const entries = RenamedEntries(from, to);
  if (Object.keys(entries).length > 0) Arrange(entries);
  if (selected.value !== null) selected.value = Renamed(selected.value, from, to);
  openGroups.value = Object.fromEntries(Object.entries(openGroups.value).map(([each, isOpen]) => [Renamed(each, from, to), isOpen]));
}

export function CreatePort(group, name, direction, type) {
  return Apply([Change.createPort(`${group}/${name}`, direction, type)], `create the ${direction} ${name}`, { quiet: true });
}

export function CreateGroup(group, name, options) {
  const path = `${group}/${name || FreeName(structure, group, 'group')}`;
  return Apply([Change.createGroup(path)], `create ${NameOf(path)}`, options);
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
export const SetLogLevel = (path, level) => Ask({ op: 'log', path, level }, `Could not set what ${NameOf(path)} logs`);
export const SetProfiled = (on) => Ask({ op: 'profile', on }, `Could not ${on ? 'begin' : 'end'} measuring`);
/** How old what comes of one output at another one is: measured, or no more. */
export const SetLatency = (from, to, on) => Ask({ op: 'latency', from, to, on }, `Could not ${on ? 'measure' : 'end measuring'} from ${Brief(from)} to ${Brief(to)}`);
/** Modules, or what a thread runs, are left out of cycles, or no more. */
export const PauseElement = (path) => Ask({ op: 'pause', path }, `Could not pause ${NameOf(path)}`);
export const ResumeElement = (path) => Ask({ op: 'resume', path }, `Could not let ${NameOf(path)} go on`);
/** `options`: { period, priority }, of which one may be left out; the period in seconds. */
export const Schedule = (path, options) => Apply([Change.schedule(path, options)], `schedule ${NameOf(path)}`);
export const CreateThread = (name, options) => Apply([Change.createThread(name, options)], `create thread ${name}`);
export const Undo = () => Travel('undo');
export const Redo = () => Travel('redo');

/** What the application says of a rename; not of one whose names it has quoted or shortened. */
const kRenamed = /^(?:undone|redone): rename (\/[^\s"]+) ([^\s"…]+)$/;

/** Says what has been undone or redone, and whose change it was. */
async function Travel(op) {
  const reply = await Ask({ op }, `Could not ${op} “${run.value[op]}”`);
  if (!reply.ok) return reply;
  const [, path, name] = kRenamed.exec(reply.text ?? '') ?? [];
  const names = path ? [path, `${ParentOf(path)}/${name}`] : [];
  if (path) Follow(...(op === 'undo' ? names.reverse() : names));
  const whose = WhoseChange(reply.client, hello.value?.viewer);
  Toast('done', reply.text || `${op} is done`, whose ? [whose] : []);
  return reply;
}

/** `client`: who has made a change, `viewer`: this one; both as the server calls them. */
export function WhoseChange(client, viewer) {
  if (!client) return '';
  if (client === viewer) return 'your change';
  return client.startsWith('viewer ') ? `a change of another viewer (${client})` : `a change of ${client}`;
}

export const Pause = () => Ask({ op: 'pause' }, 'Could not pause');
export const Resume = () => Ask({ op: 'resume' }, 'Could not go on');
export const Step = (cycles) => Ask({ op: 'step', cycles }, 'Could not step');
export const SetSpeed = (speed) => Ask({ op: 'speed', speed }, 'Could not set the speed');
export const CompatibleTypes = (path) => Ask({ op: 'compatible', path }, 'Could not ask for other types');

/** What saving would make of the application's file: {file, before, after}. */
export const PreviewSave = (file = '') => Ask({ op: 'preview', file }, 'Could not tell what saving would change', { quiet: true });

/** `overwrite`: also where another application's file is. */
export async function Save(file = '', { overwrite = false, ...options } = {}) {
  const reply = await Ask({ op: 'save', file, ...(overwrite ? { overwrite } : {}) }, 'Could not save', options);
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
  return port?.owner ? `${structure.get(port.owner)?.name ?? NameOf(port.owner)}/${port.name}` : path;
}
