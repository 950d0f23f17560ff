// One plot, drawn by uPlot, as often as something new has come and the screen is drawn anyway.

import uPlot from 'uplot';
import { effect } from '@preact/signals';
import { useEffect, useRef } from 'preact/hooks';
import { html } from 'htm/preact';
import { isDark } from '../state/choices.js';
import { FormatNumber } from '../model/value_format.js';
import { isPaused, plotWindow, pulse } from './plot_list.js';

export const CurveColour = (curve) => `var(--curve-${curve.colour % 8})`;

export function Chart({ plot }) {
  const host = useRef(null);
  const keys = plot.curves.map((curve) => curve.id).join(' ');
  useEffect(() => {
    const drawing = new Drawing(host.current, plot);
    const stop = effect(() => {
      pulse.value;
      plotWindow.value;
      if (!isPaused.value) drawing.askForFrame();
    });
    const stopTheme = effect(() => { isDark.value; drawing.recolour(); });
    const observer = new ResizeObserver(() => drawing.resize());
    observer.observe(host.current);
    return () => { stop(); stopTheme(); observer.disconnect(); drawing.end(); };
  }, [keys]);
  return html`<div class="chart" ref=${host}></div>`;
}

class Drawing {
  #host;
  #plot;
  #chart = null;
  #frame = 0;

  constructor(host, plot) {
    this.#host = host;
    this.#plot = plot;
  }

  askForFrame() {
    if (this.#frame === 0) this.#frame = requestAnimationFrame(() => { this.#frame = 0; this.#draw(); });
  }

  recolour() {
    this.#chart?.destroy();
    this.#chart = null;
    this.askForFrame();
  }

  resize() {
    this.#chart?.setSize(this.#size());
  }

  end() {
    cancelAnimationFrame(this.#frame);
    this.#chart?.destroy();
  }

  #size() {
    return { width: Math.max(60, this.#host.clientWidth), height: Math.max(60, this.#host.clientHeight) };
  }

  #draw() {
    this.#chart ??= new uPlot(Options(this.#host, this.#plot, this.#size()), null, this.#host);
    const times = this.#plot.curves.map((curve) => curve.series.lastTime).filter((time) => time !== null);
    if (times.length === 0) return;
    const to = Math.max(...times);
    const from = Math.max(0, to - plotWindow.peek());
    const tables = this.#plot.curves.map((curve) => curve.series.window(from, to));
    this.#chart.batch(() => {
      this.#chart.setData(tables.length === 1 ? tables[0] : uPlot.join(tables), false);
      this.#chart.setScale('x', { min: from, max: Math.max(to, from + plotWindow.peek()) });
    });
  }
}

function Options(host, plot, size) {
  const style = getComputedStyle(host);
  const colour = (name) => style.getPropertyValue(name).trim();
  const axis = {
    stroke: colour('--quiet'), font: '11px system-ui, sans-serif', size: 26,
    grid: { stroke: colour('--rule'), width: 1 }, ticks: { stroke: colour('--rule'), width: 1, size: 4 },
  };
  return {
    ...size,
    legend: { show: false },
    cursor: { points: { size: 6 }, drag: { x: true, y: false } },
    padding: [8, 10, 0, 0],
    scales: { x: { time: false }, y: { range: Range } },
    axes: [{ ...axis }, { ...axis, size: 52, values: (_, ticks) => ticks.map(FormatNumber) }],
    series: [{}, ...plot.curves.map((curve) => ({
      label: curve.label, stroke: colour(`--curve-${curve.colour % 8}`), width: 1.5, spanGaps: true, points: { show: false },
    }))],
  };
}

/** A curve that stands still is drawn in the middle, not as noise. */
function Range(_, least, greatest) {
  if (least === null) return [0, 1];
  const space = greatest > least ? (greatest - least) * 0.08 : Math.abs(greatest) * 0.1 || 1;
  return [least - space, greatest + space];
}
