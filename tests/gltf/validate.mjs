// Khronos' validator over every model of a folder: no error and no warning. Exit code 77: the validator is not installed.
// usage: node validate.mjs FOLDER_WITH_node_modules FOLDER_WITH_MODELS
import { createRequire } from 'node:module';
import { existsSync, readFileSync, readdirSync } from 'node:fs';
import { join } from 'node:path';

const [modules, models] = process.argv.slice(2);
if (!existsSync(join(modules, 'node_modules', 'gltf-validator'))) {
  console.log('skipped: npm package gltf-validator is not installed (npm ci needs the network once)');
  process.exit(77);
}
const validator = createRequire(join(modules, 'package.json'))('gltf-validator');
const files = readdirSync(models).filter((name) => /\.(glb|gltf)$/.test(name)).sort();
let bad = files.length === 0 ? 1 : 0;
if (bad) console.log(`no models in ${models}`);
for (const name of files) {
  const report = await validator.validateBytes(new Uint8Array(readFileSync(join(models, name))), { uri: name, maxIssues: 20 });
  const { numErrors, numWarnings, numInfos, messages } = report.issues;
  console.log(`${name}: ${numErrors} errors, ${numWarnings} warnings, ${numInfos} infos`);
  for (const issue of messages.filter((m) => m.severity <= 1)) {
    bad = 1;
    console.log(`  ${issue.code} ${issue.pointer ?? ''} ${issue.message}`);
  }
}
process.exit(bad);
