// The page at an application that is none: a robot in a room.

import { MockApplication } from '../mock/mock_application.mjs';
import { ServeMock } from '../mock/mock_server.mjs';
import { RobotStructure, RobotValues, kCatalogue } from '../mock/mock_structures.mjs';
import { OpenPage } from './browser.mjs';
import { Cleanup } from './cleanup.mjs';

export async function OpenMock(t, options = {}) {
  const application = new MockApplication({ name: 'robot', catalogue: kCatalogue, structure: RobotStructure(), values: RobotValues(() => application) });
  const server = await ServeMock(application, { page: process.env.RUNNEL_PAGE });
  Cleanup(t, () => server.close());
  const inspector = await OpenPage(t, server.url, options);
  return { application, server, inspector, page: inspector.page };
}
