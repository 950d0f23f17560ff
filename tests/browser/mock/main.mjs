// For a look by hand: node mock/main.mjs <folder of the page> [robot|large] [port]

import { MockApplication } from './mock_application.mjs';
import { ServeMock } from './mock_server.mjs';
import { LargeStructure, RobotStructure, RobotValues, kCatalogue } from './mock_structures.mjs';

const [page, kind = 'robot', port = '8777'] = process.argv.slice(2);
const application = new MockApplication({ name: kind, catalogue: kCatalogue,
  structure: kind === 'large' ? LargeStructure() : RobotStructure(), values: kind === 'large' ? {} : RobotValues(() => application) });
const server = await ServeMock(application, { page, port: Number(port) });
console.log(server.url);
