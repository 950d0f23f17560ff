// Makes the page's files: node bundle.mjs <folder for them> <folder of packages (node_modules)>.

import { copyFile, mkdir, readFile, writeFile } from 'node:fs/promises';
import { dirname, join } from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';

const here = dirname(fileURLToPath(import.meta.url));
const [folder, packages] = process.argv.slice(2);
if (!folder || !packages) throw new Error('usage: node bundle.mjs <folder> <node_modules>');
const { default: esbuild } = await import(pathToFileURL(join(packages, 'esbuild/lib/main.js')));

await mkdir(folder, { recursive: true });
// Packages lie in the build tree, not beside the sources.
const options = { outdir: folder, bundle: true, minify: true, nodePaths: [packages], logLevel: 'warning', logLimit: 5 };
const panel = join(here, '../panel'); // the operator's, which shares this page's sources
// world_3d apart: the page fetches it when somebody wants to look in three dimensions.
await esbuild.build({ ...options, format: 'esm', target: ['es2022'], entryPoints: { page: join(here, 'source/main.js'),
  panel: join(panel, 'source/main.js'), world_3d: join(here, 'source/world_3d/main.js') } });
await esbuild.build({ ...options, entryPoints: { page: join(here, 'source/style.css'), panel: join(panel, 'source/style.css') } });
for (const file of ['index.html', 'icon.svg']) await copyFile(join(here, file), join(folder, file));
await copyFile(join(panel, 'index.html'), join(folder, 'panel.html'));

// What the licences of the packages ask for: their notices go with the copy.
const licences = [];
for (const name of ['@dagrejs/dagre', '@dagrejs/graphlib', '@preact/signals', '@preact/signals-core', 'htm', 'preact', 'three', 'uplot']) {
  const { version, license } = JSON.parse(await readFile(join(packages, name, 'package.json'), 'utf8'));
  const text = await readFile(join(packages, name, 'LICENSE'), 'utf8');
  licences.push(`${name} ${version} (${license})\n\n${text.trim()}\n`);
}
await writeFile(join(folder, 'licences.txt'), licences.join(`\n${'-'.repeat(72)}\n\n`));
