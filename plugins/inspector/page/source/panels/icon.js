// Icons as strokes of the text's colour.

import { html } from 'htm/preact';

const kIcons = {
  mark: 'M3 5c5 0 5 7 10 7s5-7 10-7M3 19c5 0 5-7 10-7s5 7 10 7',
  pause: 'M8 5v14M16 5v14',
  play: 'M7 4.5v15l12-7.5z',
  step: 'M6 4.5v15l9-7.5zM18.5 5v14',
  undo: 'M9 6L4 11l5 5M4.5 11H14a5.5 5.5 0 0 1 0 11h-3',
  redo: 'M15 6l5 5-5 5M19.5 11H10a5.5 5.5 0 0 0 0 11h3',
  save: 'M5 4h11l4 4v12H4V5a1 1 0 0 1 1-1zM8 4v5h7V4M8 20v-6h8v6',
  more: 'M6 10l6 6 6-6',
  less: 'M6 15l6-6 6 6',
  alarm: 'M12 3.5l9.5 16.5h-19zM12 10v4.5M12 17.2v.3',
  stop: 'M8 3h8l5 5v8l-5 5H8l-5-5V8z',
  tune: 'M4 8h9M17 8h3M4 16h3M11 16h9M15 5.5v5M9 13.5v5',
  list: 'M4 6h16M4 12h16M4 18h10',
  panel: 'M4 5h16v14H4zM14.5 5v14',
  add: 'M12 5v14M5 12h14',
  world: 'M3 6l6-2 6 2 6-2v14l-6 2-6-2-6 2zM9 4v14M15 6v14',
  light: 'M12 8a4 4 0 1 0 0 8 4 4 0 0 0 0-8zM12 2v2.5M12 19.5V22M2 12h2.5M19.5 12H22M5 5l1.7 1.7M17.3 17.3L19 19M5 19l1.7-1.7M17.3 6.7L19 5',
  dark: 'M20 14.5A8.5 8.5 0 0 1 9.5 4a8.5 8.5 0 1 0 10.5 10.5z',
  system: 'M4 5h16v11H4zM9 20h6M12 16v4',
  close: 'M6 6l12 12M18 6L6 18',
  plot: 'M4 4v16h16M7 15l4-5 3 3 5-7',
  large: 'M14 4h6v6M20 4l-7 7M10 20H4v-6M4 20l7-7',
  small: 'M20 10h-6V4M14 10l7-7M4 14h6v6M10 14l-7 7',
  follow: 'M12 8a4 4 0 1 0 0 8 4 4 0 0 0 0-8zM12 2v4M12 18v4M2 12h4M18 12h4',
  fit: 'M4 9V4h5M15 4h5v5M20 15v5h-5M9 20H4v-5',
  swap: 'M4 8h14l-4-4M20 16H6l4 4',
  trash: 'M5 7h14M10 7V4h4v3M7 7l1 13h8l1-13',
  plug: 'M4 12h6M20 12h-6M10 8v8a2 2 0 0 0 2-2v-4a2 2 0 0 0-2-2zM14 9v6',
  drive: 'M12 10V17M12 4a3 3 0 1 0 0 6 3 3 0 0 0 0-6zM5 20a7 3.4 0 0 1 14 0z',
  reset: 'M5 4v5h5M5.5 9a8 8 0 1 1-1 6',
  edit: 'M4 20l1-5L16 4l4 4L9 19zM14 6l4 4',
  cube: 'M12 3l8 4.5v9L12 21l-8-4.5v-9zM4 7.5l8 4.5 8-4.5M12 12v9',
  layers: 'M12 4l9 5-9 5-9-5zM3 14l9 5 9-5',
};

export function Icon({ name, size = 18 }) {
  return html`<svg class="icon" viewBox="0 0 24 24" width=${size} height=${size} aria-hidden="true"
    fill=${name === 'play' ? 'currentColor' : 'none'}><path d=${kIcons[name]} /></svg>`;
}
