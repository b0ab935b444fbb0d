"""Asks a running headless viewer for a screenshot; used by screenshot_rerun.sh."""

import sys
import time

from rerun.experimental import ViewerClient

# The viewer loads the recording and draws the first frames meanwhile.
LOADING = 12.0


def main(port, picture):
    url = f"rerun+http://127.0.0.1:{port}/proxy"
    for attempt in range(30):
        try:
            client = ViewerClient.connect(url=url)
            break
        except Exception:
            if attempt == 29:
                raise
            time.sleep(1.0)
    time.sleep(LOADING)
    client.save_screenshot(picture)
    print(picture)


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2])
