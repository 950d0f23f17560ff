// The page at an application that is none: a robot in a room.

import { MockApplication } from '../mock/mock_application.mjs';
import { ServeMock } from '../mock/mock_server.mjs';
import { RobotStructure, RobotValues, kCatalogue } from '../mock/mock_structures.mjs';
import { OpenPage } from './browser.mjs';
import { OpenPanel } from './panel.mjs';
import { Cleanup } from './cleanup.mjs';

function Robot() {
  const application = new MockApplication({ name: 'robot', catalogue: kCatalogue, structure: RobotStructure(), values: RobotValues(() => application) });
  return application;
}

/** The operator's panel at the same; `widgets`: those that have been saved. */
export async function OpenMockPanel(t, { widgets, prepare, readOnly = false, ...options } = {}) {
  const application = Robot();
  if (widgets) application.panel = JSON.stringify({ panel: 1, widgets });
  prepare?.(application);
  const server = await ServeMock(application, { page: process.env.RUNNEL_PAGE, readOnly });
  Cleanup(t, () => server.close());
  const panel = await OpenPanel(t, server.url, options);
  return { application, server, panel, page: panel.page };
}

export async function OpenMock(t, { prepare, ...options } = {}) {
  const application = Robot();
  prepare?.(application);
  const server = await ServeMock(application, { page: process.env.RUNNEL_PAGE });
  Cleanup(t, () => server.close());
  const inspector = await OpenPage(t, server.url, options);
  return { application, server, inspector, page: inspector.page };
}
