// End to end: the page in headless Chromium against a live view, in this order.
//   node tests/view/page_test.mjs [ADDRESS] [--screenshots DIRECTORY]
// ADDRESS is what the program prints, with its token; without one the mock server is started.
import './picture_tests.mjs';
import './tool_tests.mjs';
import './window_tests.mjs';
