// The panel of plots: what is plotted, pause, and how much time is shown.

import { html } from 'htm/preact';
import { FormatNumber } from '../model/value_format.js';
import { Icon } from '../panels/icon.js';
import { Chart, CurveColour } from './chart.js';
import { RemoveCurve, RemovePlot, isPaused, plotWindow, plots, pulse } from './plot_list.js';

const kWindows = [5, 10, 20, 60, 300];

export function Plots() {
  if (plots.value.length === 0) {
    return html`<p class="empty">Nothing is plotted. Select a port, and press
      <${Icon} name="plot" size=${15} /> beside a number.</p>`;
  }
  return html`
    <div class="plots" id="plots">
      <div class="plot-tools" role="group" aria-label="Plots">
        <button id="plot-pause" aria-pressed=${isPaused.value} onClick=${() => { isPaused.value = !isPaused.value; }}>
          <${Icon} name=${isPaused.value ? 'play' : 'pause'}
              size=${14} />${isPaused.value ? 'Go on' : 'Pause'}</button>
        <label>show <select id="plot-window" value=${plotWindow.value}
            onChange=${(event) => { plotWindow.value = Number(event.target.value); }}>
          ${kWindows.map((seconds) => html`<option key=${seconds} value=${seconds}
              selected=${seconds === plotWindow.value}>
            ${seconds < 60 ? `${seconds} s` : `${seconds / 60} min`}</option>`)}</select></label>
      </div>
      <div class="plot-list">${plots.value.map((plot) => html`<${PlotView} key=${plot.id} plot=${plot} />`)}</div>
    </div>`;
}

function PlotView({ plot }) {
  return html`
    <figure class="plot" aria-label=${`Plot of ${plot.curves.map((curve) => curve.label).join(', ')}`}>
      <figcaption>
        ${plot.curves.map((curve) => html`<${Legend} key=${curve.id} plot=${plot} curve=${curve} />`)}
        <span class="unit">${plot.unit}</span>
        <button class="remove" aria-label="Close the plot" title="Close the plot"
            onClick=${() => RemovePlot(plot.id)}>✕</button>
      </figcaption>
      <${Chart} plot=${plot} />
    </figure>`;
}

function Legend({ plot, curve }) {
  pulse.value;
  const { values } = curve.series;
  return html`<span class="legend"><i style=${{ background: CurveColour(curve) }}></i>${curve.label}
    <output>${values.length > 0 ? FormatNumber(values[values.length - 1]) : '–'}</output>
    <button class="remove" aria-label=${`Remove ${curve.label}`}
        onClick=${() => RemoveCurve(plot.id, curve.id)}>✕</button></span>`;
}
