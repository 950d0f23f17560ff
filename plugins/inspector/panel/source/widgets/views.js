// Plot, map and picture, drawn by what draws those of the inspector.

import { useEffect, useMemo } from 'preact/hooks';
import { html } from 'htm/preact';
import { ImagePicture } from '../../../page/source/panels/image_picture.js';
import { FormatNumber } from '../../../page/source/model/value_format.js';
import { NumberAt } from '../../../page/source/model/value_rows.js';
import { NameOf } from '../../../page/source/model/structure.js';
import { Chart, CurveColour } from '../../../page/source/plots/chart.js';
import { pulse } from '../../../page/source/plots/plot_list.js';
import { Series } from '../../../page/source/plots/series.js';
import { catalogue, revision, structure, watches } from '../../../page/source/state/store.js';
import { WorldView, hasWorld } from '../../../page/source/world/world_view.js';
import { StepsOf, UnitOf } from '../model/fields.js';

export function Plot({ widget }) {
  const wanted = (widget.curves ?? []).filter(({ target }) => target);
  const key = wanted.map(({ target, field }) => `${target}.${field ?? ''}`).join(' ');
  const plot = useMemo(() => ({ curves: wanted.map(({ target, field = '' }, index) => ({ id: `${key} ${index}`, target, field, colour: index,
    label: `${NameOf(structure.get(target)?.owner ?? '')}/${NameOf(target)}${field ? `.${field}` : ''}`, series: new Series() })) }), [key]);
  useEffect(() => {
    const ends = plot.curves.map((curve) => watches.watch(curve.target, { rate: 30, elements: 20, onValue: (item) => {
      if (item) curve.series.add(item.stamp, Seen(NumberAt(item.value, StepsOf(curve.field))));
      else curve.series.clear();
      pulse.value += 1;
    } }).end);
    return () => { for (const end of ends) end(); };
  }, [plot]);
  if (wanted.length === 0) return html`<p class="none widget-problem">no curve has been chosen</p>`;
  return html`
    <figure class="plot">
      <figcaption>${plot.curves.map((curve) => html`<${Legend} key=${curve.id} curve=${curve} />`)}</figcaption>
      <${Chart} key=${key} plot=${plot} />
    </figure>`;
}

/** What is left over of a sum is no motion. */
function Seen(number) {
  return number !== null && Math.abs(number) < 1e-9 ? 0 : number;
}

function Legend({ curve }) {
  pulse.value;
  revision.value;
  const { values } = curve.series;
  return html`<span class="legend"><i style=${{ background: CurveColour(curve) }}></i>${curve.label}
    <output>${values.length > 0 ? FormatNumber(values[values.length - 1]) : '–'}</output>
    <small>${UnitOf(catalogue.value, structure.get(curve.target), curve.field)}</small></span>`;
}

export function Picture({ widget }) {
  revision.value;
  if (!widget.target) return html`<p class="none widget-problem">no port has been chosen</p>`;
  if (!structure.get(widget.target)) return html`<p class="none widget-problem">${widget.target} is not there</p>`;
  return html`<${ImagePicture} path=${widget.target} />`;
}

export function WorldMap() {
  if (!hasWorld.value) return html`<p class="none widget-problem">nothing here says where it is</p>`;
  return html`<${WorldView} />`;
}
