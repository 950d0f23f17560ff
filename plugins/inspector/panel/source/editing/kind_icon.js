// Icons of the kinds of widgets, as strokes of the text's colour.

import { html } from 'htm/preact';

const kPaths = {
  joystick: 'M12 10V17M12 4a3 3 0 1 0 0 6 3 3 0 0 0 0-6zM5 20a7 3.4 0 0 1 14 0z',
  keys: 'M9 4h6v6H9zM2 13h6v6H2zM9 13h6v6H9zM16 13h6v6h-6z',
  gamepad: 'M7 7h10a5 5 0 0 1 5 5.5c0 3-1 5.5-3 5.5-1.600 0-2.500-3-4-3H9c-1.500 0-2.400 3-4 3-2 0-3-2.500-3-5.500A5 5 0 0 1 7 7zM8 10v4M6 12h4M16 12h.01',
  stop: 'M8 3h8l5 5v8l-5 5H8l-5-5V8z',
  slider: 'M3 12h18M9 8v8',
  button: 'M4 8h16v8H4zM9 12h6',
  switch: 'M8 7h8a5 5 0 0 1 0 10H8A5 5 0 0 1 8 7zM16 9.500a2.500 2.500 0 1 0 0 5 2.500 2.500 0 0 0 0-5z',
  gauge: 'M4 17a9 9 0 1 1 16 0M12 14l4-5',
  plot: 'M4 4v16h16M7 15l4-5 3 3 5-7',
  world: 'M3 6l6-2 6 2 6-2v14l-6 2-6-2-6 2zM9 4v14M15 6v14',
  image: 'M3 5h18v14H3zM3 16l5-5 4 4 3-3 6 5M15 9h.01',
  value: 'M5 8h14M5 12h9M5 16h12',
  text: 'M5 6h14M12 6v13',
  theme: 'M12 3a9 9 0 1 0 0 18zM12 3a9 9 0 0 1 0 18',
  edit: 'M4 20l1-5L16 4l4 4L9 19zM14 6l4 4',
};

export function KindIcon({ name, size = 17 }) {
  return html`<svg class="icon" viewBox="0 0 24 24" width=${size} height=${size} fill="none" aria-hidden="true"><path d=${kPaths[name]} /></svg>`;
}
