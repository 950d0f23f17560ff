// What sliders, buttons and switches set: a parameter, or an input by hand.

import { html } from 'htm/preact';
import { useState } from 'preact/hooks';
import { useWatched } from '../../../page/source/panels/use_watched.js';
import { ErrorText, PublishByHand, SetParameter } from '../../../page/source/state/actions.js';
import { canChange, canDrive, refusals, revision, structure } from '../../../page/source/state/store.js';
import { GiveBack, hands } from '../driving/driving.js';

/** Of what moves: a value that is set once would stay when nobody is there any more. */
export const kOnlyHeldDrives = 'something moves by it, and only what is held drives: take a slider or a button';

/** {element, isPort, value, locked, problem, set(text), note}: `value` as the application has it, a number, text, flag or null. */
export function useTarget(widget) {
  revision.value;
  refusals.value;
  const [problem, setProblem] = useState('');
  const element = widget.target ? structure.get(widget.target) : null;
  const isPort = element?.kind === 'port';
  const watched = useWatched(isPort ? widget.target : '', { rate: 10 });
  const value = isPort ? watched?.value ?? null : Plain(element?.value);
  const set = async (text) => {
    if (isPort && structure.get(widget.target)?.moves) {
      setProblem(kOnlyHeldDrives);
      return false;
    }
    const reply = isPort ? await PublishByHand(widget.target, text, null) : await SetParameter(widget.target, text, { quiet: true });
    setProblem(reply.ok ? '' : (reply.errors ?? []).map(ErrorText).join('\n') || 'it was refused');
    return reply.ok;
  };
  const missing = !widget.target ? 'nothing has been chosen' : !element ? `${widget.target} is not there` : '';
  const note = html`<${TargetNote} path=${widget.target} isPort=${isPort} problem=${missing || problem} />`;
  return { element, isPort, value, locked: !(isPort ? canDrive : canChange).value || !element, set, note };
}

function TargetNote({ path, isPort, problem }) {
  const isByHand = isPort && hands.value[path];
  return html`${isByHand && html`<div class="driving-state"><span class=${`driving-chip ${hands.value[path]}`}>by hand</span>
      <button class="give-back" disabled=${!canDrive.value} onClick=${() => GiveBack([path])}>Give back</button></div>`}
    ${problem && html`<p class="problem widget-problem" role="alert">${problem}</p>`}`;
}

function Plain(text) {
  if (text === undefined || text === null) return null;
  if (text === 'true' || text === 'false') return text === 'true';
  return text.trim() !== '' && Number.isFinite(Number(text)) ? Number(text) : text;
}
