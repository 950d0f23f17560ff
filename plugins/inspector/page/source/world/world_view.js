// The world: what the application says of where its robot is, drawn as a map.

import { computed, useSignal } from '@preact/signals';
import { useEffect, useRef } from 'preact/hooks';
import { html } from 'htm/preact';
import { SetPanels, panels } from '../state/choices.js';
import { catalogue, revision, structure } from '../state/store.js';
import { Icon } from '../panels/icon.js';
import { ToCanvas } from './camera.js';
import { GoalHandle } from './goal_handle.js';
import { FindLayers } from './layers.js';
import { SolidView } from './solid_view.js';
import { WorldScene } from './world_scene.js';

const kListed = 100;

const found = computed(() => {
  revision.value;
  return FindLayers(structure, catalogue.value);
});

/** Whether the application has anything to be drawn: a pose, a scan, a path … */
export const hasWorld = computed(() => found.value.layers.length > 0);

export function WorldView() {
  return html`<${World} key=${found.value.key} found=${found.value} />`;
}

function World({ found }) {
  const host = useRef(null);
  const canvas = useRef(null);
  const scene = useRef(null);
  scene.current ??= new WorldScene(found);
  const showsLayers = useSignal(false);
  useEffect(() => scene.current.attach(host.current, canvas.current), []);
  const { camera, size, following, goals, choices } = scene.current;
  choices.value;
  const isSolid = panels.value.worldSolid ?? false;
  return html`
    <section class=${`world ${isSolid ? 'solid' : ''}`} aria-label="World" id="world">
      ${isSolid && html`<${SolidView} scene=${scene.current} />`}
      <div class="world-map">
      <div class="world-canvas" ref=${host} tabindex="0" aria-label="Map: drag to move, wheel to zoom" role="img"
           onKeyDown=${(event) => scene.current.onKey(event)}>
        <canvas ref=${canvas}></canvas></div>
      ${goals.value.map(({ layer, place }) => html`<${GoalHandle} key=${layer.port} layer=${layer}
        point=${ToCanvas(camera.value, size.value, place)} place=${place} scene=${scene.current} />`)}
      </div>
      <div class="world-tools" role="group" aria-label="Map">
        <button aria-pressed=${following.value} onClick=${() => scene.current.follow(!following.value)}
            title="Follow the robot"
          aria-label="Follow the robot" id="follow"><${Icon} name="follow" size=${16} /></button>
        <button aria-pressed=${isSolid} onClick=${() => SetPanels({ worldSolid: !isSolid })} title="Three dimensions" id="solid"
          aria-label="Three dimensions"><${Icon} name="cube" size=${16} /></button>
        <button onClick=${() => scene.current.fitAll()} title="Show all"
            aria-label="Show all of the world"><${Icon} name="fit" size=${16} /></button>
        <button aria-pressed=${showsLayers.value} onClick=${() => { showsLayers.value = !showsLayers.value; }}
            title="Layers"
          aria-label="Layers"><${Icon} name="layers" size=${16} /></button>
        <button aria-pressed=${panels.value.worldLarge} onClick=${() => SetPanels({ worldLarge: !panels.value.worldLarge })}
          title=${panels.value.worldLarge ? 'Small' : 'Large'}
          aria-label=${panels.value.worldLarge ? 'Small map' : 'Large map'}>
          <${Icon} name=${panels.value.worldLarge ? 'small' : 'large'} size=${16} /></button>
      </div>
      ${showsLayers.value && html`<fieldset class="layers"><legend>Layers</legend>
        ${found.layers.slice(0, kListed).map((layer) => html`<label key=${layer.port} title=${layer.port}>
          <input type="checkbox" checked=${scene.current.isShown(layer)}
            onChange=${(event) => scene.current.show(layer, event.target.checked)} />
          ${layer.label} <small>${layer.meaning.replaceAll('_', ' ')}</small></label>`)}
        ${found.layers.length > kListed && html`<p class="none">… and ${found.layers.length - kListed} more</p>`}</fieldset>`}
    </section>`;
}
