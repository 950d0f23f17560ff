// What is in the frame of a widget.

import { html } from 'htm/preact';
import { StopButton } from '../../../page/source/stop/stop_view.js';
import { Gamepad } from './gamepad.js';
import { Joystick } from './joystick.js';
import { Keys } from './keys.js';
import { Gauge, Text, Value } from './readings.js';
import { Button, Slider, Switch } from './setters.js';
import { Picture, Plot, WorldMap } from './views.js';

const kViews = { joystick: Joystick, keys: Keys, gamepad: Gamepad, slider: Slider, button: Button, switch: Switch,
  gauge: Gauge, plot: Plot, map: WorldMap, image: Picture, value: Value, text: Text, stop: StopWidget };

/** Of panels from before the page had its own: it does the same. */
function StopWidget() {
  return html`<div class="stop-widget"><${StopButton} /></div>`;
}

export function WidgetView({ widget }) {
  const View = kViews[widget.kind];
  return View ? html`<${View} key=${`${widget.id} ${widget.target ?? ''}`} widget=${widget} />`
    : html`<p class="none widget-problem">this page has no “${widget.kind}”</p>`;
}
