// How long a module takes, in its box, while modules are measured.

import { useComputed } from '@preact/signals';
import { html } from 'htm/preact';
import { FormatMicroseconds } from '../model/value_format.js';
import { profile } from '../state/store.js';

export function BoxTime({ path, x, y }) {
  const text = useComputed(() => {
    const { on, tasks } = profile.value;
    const mean = on ? tasks.filter((task) => task.path === path).reduce((sum, task) => sum + task.mean_us, 0) : 0;
    return mean > 0 ? FormatMicroseconds(mean) : '';
  });
  return text.value && html`<text class="time-taken" x=${x} y=${y} text-anchor="end">${text.value}</text>`;
}
