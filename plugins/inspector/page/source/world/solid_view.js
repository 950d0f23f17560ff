// The world in three dimensions, beside the map or instead of it. Its script is fetched when somebody looks.

import { effect } from '@preact/signals';
import { useEffect, useRef, useState } from 'preact/hooks';
import { html } from 'htm/preact';
import { isDark } from '../state/choices.js';

const kScript = '/world_3d.js';

let script = null;

function Load() {
  script ??= import(kScript).catch((error) => {
    script = null; // the next one who looks tries again
    throw error;
  });
  return script;
}

/** `scene`: the WorldScene that has the layers and their values. */
export function SolidView({ scene }) {
  const host = useRef(null);
  const canvas = useRef(null);
  const [problem, setProblem] = useState('');
  useEffect(() => {
    let view = null;
    let isGone = false;
    const ends = [];
    Load().then(({ World3D }) => {
      if (isGone) return;
      view = new World3D(canvas.current, { onMove: () => scene.follow(false) });
      const resize = () => view.resize(host.current.clientWidth, host.current.clientHeight, devicePixelRatio || 1);
      const observer = new ResizeObserver(resize);
      observer.observe(host.current);
      ends.push(() => observer.disconnect(),
        effect(() => { view.setColours({ ...SolidColours(host.current), isDark: isDark.value }); scene.askForFrame(); }),
        effect(() => view.follow(scene.following.value)),
        scene.showIn(view));
      resize();
    }).catch((error) => {
      setProblem(/webgl/i.test(error.message) ? 'This browser shows no three-dimensional pictures (WebGL).'
        : 'The three-dimensional view could not be fetched.');
    });
    return () => {
      isGone = true;
      for (const end of ends) end();
      view?.dispose();
    };
  }, [scene]);
  return html`<div class="world-solid" ref=${host}>
    <canvas ref=${canvas} tabindex="0" role="img" aria-label="World in three dimensions: drag to turn, right drag to move, wheel to zoom"></canvas>
    ${problem && html`<p class="empty" role="alert">${problem}</p>`}</div>`;
}

function SolidColours(host) {
  const style = getComputedStyle(host);
  const names = { ground: '--world-ground', wall: '--world-solid-wall', wallEdge: '--world-wall-edge', path: '--world-path', echo: '--world-echo',
    hit: '--world-hit', leave: '--world-leave', goal: '--world-goal', robot: '--world-robot', robotBody: '--world-robot-body',
    robotDark: '--world-robot-dark', robotSign: '--world-robot-sign' };
  return Object.fromEntries(Object.entries(names).map(([name, variable]) => [name, style.getPropertyValue(variable).trim()]));
}
