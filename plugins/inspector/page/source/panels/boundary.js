// What cannot be drawn takes nothing else with it.

import { useEffect, useErrorBoundary } from 'preact/hooks';
import { html } from 'htm/preact';

/** Its children, or why they cannot be drawn; tried again when `of` is another one. */
export function Boundary({ what, of, children }) {
  const [error, again] = useErrorBoundary((thrown) => console.error(`${what} cannot be drawn:`, thrown));
  useEffect(() => { if (error) again(); }, [of]);
  if (!error) return children;
  return html`<div class="broken" role="alert"><p class="problem">${what} cannot be drawn: ${String(error.message ?? error)}</p>
    <button onClick=${again}>Try again</button></div>`;
}
