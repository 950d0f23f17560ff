// Stops everything at once, and lets it go on: simulated time stands still; on a real clock no module runs.

import { html } from 'htm/preact';
import { Pause, PauseElement, Resume, ResumeElement } from '../state/actions.js';
import { canChange, canDrive, hello, revision, run, structure } from '../state/store.js';
import { Icon } from './icon.js';

export function StopButton() {
  revision.value;
  const isSimulated = hello.value?.clock === 'simulated';
  const stands = isSimulated ? run.value.paused : structure.get(structure.root)?.paused === true;
  const press = () => {
    if (isSimulated) return stands ? Resume() : Pause();
    return stands ? ResumeElement(structure.root) : PauseElement(structure.root);
  };
  return html`<button id="stop" class=${`stop ${stands ? 'stands' : ''}`} aria-pressed=${stands} onClick=${press}
    disabled=${!(isSimulated ? canDrive : canChange).value || run.value.ended}><${Icon} name=${stands ? 'play' : 'stop'} size=${20} />${stands ? 'Go on' : 'Stop'}</button>`;
}
