// Bundles the tests of plain logic, so that they find the page's packages in the build tree:
// node bundle_units.mjs <folder for them> <node_modules of the page>

import { readdir } from 'node:fs/promises';
import { dirname, join } from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';

const here = dirname(fileURLToPath(import.meta.url));
const [folder, packages] = process.argv.slice(2);
const { default: esbuild } = await import(pathToFileURL(join(packages, 'esbuild/lib/main.js')));
const tests = (await readdir(join(here, 'unit'))).filter((name) => name.endsWith('.test.mjs'));
await esbuild.build({
  entryPoints: tests.map((name) => join(here, 'unit', name)), outdir: folder, outExtension: { '.js': '.mjs' },
  bundle: true, platform: 'node', format: 'esm', nodePaths: [packages], sourcemap: 'inline', logLevel: 'warning', logLimit: 5,
});
