// What widgets there are: their names, sizes, and what can be set of each. The server knows the same kinds
// (panel_file.cpp).

/**
 * settings: {name, label, kind: 'target' | 'input' | 'output' | 'field' | 'number' | 'text' | 'flag' | 'curves', …}; target:
 * an input or a parameter. `first`: as a new one has it.
 */
export const kKinds = {
  joystick: { label: 'Joystick', icon: 'joystick', w: 4, h: 6, least: { w: 2, h: 4 }, drives: true },
  keys: { label: 'Keys', icon: 'keys', w: 3, h: 4, least: { w: 2, h: 3 }, drives: true },
  gamepad: { label: 'Gamepad', icon: 'gamepad', w: 3, h: 4, least: { w: 2, h: 3 }, drives: true },
  stop: { label: 'STOP', icon: 'stop', w: 3, h: 3, least: { w: 2, h: 2 }, isOld: true }, // each page has one that no panel can lose
  slider: { label: 'Slider', icon: 'slider', w: 4, h: 2, least: { w: 2, h: 2 },
    settings: [{ name: 'target', label: 'Sets', kind: 'target' }, { name: 'minimum', label: 'From', kind: 'number' },
      { name: 'maximum', label: 'To', kind: 'number' }, { name: 'step', label: 'Step', kind: 'number' }] },
  button: { label: 'Button', icon: 'button', w: 2, h: 2, least: { w: 1, h: 1 },
    settings: [{ name: 'target', label: 'Sets', kind: 'target' }, { name: 'pressed', label: 'To', kind: 'text' },
      { name: 'held', label: 'Only while it is held', kind: 'flag', note: 'ports only: then their safe value' }] },
  switch: { label: 'Switch', icon: 'switch', w: 3, h: 2, least: { w: 2, h: 1 },
    settings: [{ name: 'target', label: 'Sets', kind: 'target' }, { name: 'on', label: 'On', kind: 'text', usual: 'true' },
      { name: 'off', label: 'Off', kind: 'text', usual: 'false' }] },
  gauge: { label: 'Gauge', icon: 'gauge', w: 2, h: 4, least: { w: 2, h: 3 },
    settings: [{ name: 'target', label: 'Port', kind: 'output' }, { name: 'field', label: 'Number', kind: 'field' },
      { name: 'minimum', label: 'From', kind: 'number' }, { name: 'maximum', label: 'To', kind: 'number' }] },
  plot: { label: 'Plot', icon: 'plot', w: 6, h: 4, least: { w: 3, h: 3 },
    settings: [{ name: 'curves', label: 'Curves', kind: 'curves' }] },
  map: { label: 'Map', icon: 'world', w: 6, h: 8, least: { w: 3, h: 4 } },
  image: { label: 'Image', icon: 'image', w: 4, h: 6, least: { w: 2, h: 3 },
    settings: [{ name: 'target', label: 'Port', kind: 'output', meaning: 'image' }] },
  value: { label: 'Value', icon: 'value', w: 3, h: 3, least: { w: 2, h: 2 },
    settings: [{ name: 'target', label: 'Port', kind: 'output' }, { name: 'field', label: 'Part', kind: 'field' }] },
  text: { label: 'Text', icon: 'text', w: 3, h: 2, least: { w: 1, h: 1 },
    settings: [{ name: 'text', label: 'Text', kind: 'text' }] },
};

const kDriving = [{ name: 'target', label: 'Drives', kind: 'input', meaning: 'twist' },
  { name: 'forward', label: 'Ahead at most', kind: 'number', unit: 'm/s' },
  { name: 'turn', label: 'Turns at most', kind: 'number', unit: 'rad/s' }];

export function SettingsOf(kind) {
  const title = { name: 'title', label: 'Title', kind: 'text' };
  return [title, ...(kKinds[kind]?.drives ? kDriving : kKinds[kind]?.settings ?? [])];
}

export const kDrivesAtFirst = { forward: 0.4, turn: 1 };

/** A name that no widget has. */
export function FreeId(widgets, kind) {
  for (let number = 1; ; ++number) {
    const id = number === 1 ? kind : `${kind}_${number}`;
    if (!widgets.some((each) => each.id === id)) return id;
  }
}

/** The panel as it is saved: one widget a line, so that people and git read it. */
export function PanelText(widgets) {
  return `{"panel": 1, "widgets": [\n${widgets.map((each) => `  ${JSON.stringify(each)}`).join(',\n')}\n]}\n`;
}

export function ParsePanel(text) {
  return JSON.parse(text).widgets;
}
