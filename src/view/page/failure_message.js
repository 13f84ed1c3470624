// Says in the middle of the stage why there is no picture, or no new one.

import { byId } from './dom.js';

export class FailureMessage {
  setState({ status, message, version }) {
    const failed = status === 'failed';
    byId('failure').hidden = !failed;
    byId('failure-text').textContent = failed ? message : '';
    // Without a picture there is nothing to control.
    document.body.classList.toggle('no-picture', failed && version === 0);
  }
}
