// Has all of it stand still, and lets it go on: simulated time stops; on a real clock no module runs. It is no STOP.

import { html } from 'htm/preact';
import { Pause, PauseElement, Resume, ResumeElement } from '../state/actions.js';
import { canChange, canDrive, hello, revision, run, structure } from '../state/store.js';
import { Icon } from './icon.js';

export function PauseButton() {
  revision.value;
  const isSimulated = hello.value?.clock === 'simulated';
  const stands = isSimulated ? run.value.paused : structure.get(structure.root)?.paused === true;
  const press = () => {
    if (isSimulated) return stands ? Resume() : Pause();
    return stands ? ResumeElement(structure.root) : PauseElement(structure.root);
  };
  return html`<button id="pause-all" class=${stands ? 'stands' : ''} aria-pressed=${stands} onClick=${press}
    disabled=${!(isSimulated ? canDrive : canChange).value || run.value.ended}><${Icon} name=${stands ? 'play' : 'pause'} size=${20} />${stands ? 'Go on' : 'Pause'}</button>`;
}
