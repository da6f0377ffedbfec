# SPDX-License-Identifier: MIT
"""Serves the page to the people who were meant: no foreign page drives, and nobody makes it public."""

import contextlib
import io
import ipaddress
import socket
import threading
from typing import Any, List, Optional
from urllib.parse import urlsplit

import viser
import websockets.asyncio.server

_starting = threading.Lock()


class _Server(viser.ViserServer):
    def request_share_url(self, verbose: bool = True) -> Optional[str]:
        """Opens no tunnel: viser lets every client ask for one through share.viser.studio."""
        return None


def is_own_page(origins: List[str], hosts: List[str], host: str) -> bool:
    """Returns whether a request comes from the page itself, or from a program, which names no origin.

    A page of another site has another origin. A site whose name was made to point here has its own name as host, so
    a name has to be one of this machine.

    origins, hosts : values of the request's headers Origin and Host
    host : where the page is served
    """
    if not origins:
        return True
    if len(hosts) != 1 or origins != [f"http://{hosts[0]}"]:
        return False
    name = urlsplit(origins[0]).hostname or ""
    machine = socket.gethostname().lower()
    if name in (host.lower(), "localhost", machine, f"{machine}.local"):  # .local: by mDNS
        return True
    try:
        ipaddress.ip_address(name)
    except ValueError:
        return False
    return True


def start_server(host: str, port: int) -> Any:
    """Returns viser's server, started, that answers its own page alone.

    viser hands no check of origins to websockets.serve(), so that is replaced while viser starts.
    """
    serve = websockets.asyncio.server.serve

    def serve_own(*arguments: Any, process_request: Any, **options: Any) -> Any:
        def check(connection: Any, request: Any) -> Any:
            headers = request.headers
            if is_own_page(headers.get_all("Origin"), headers.get_all("Host"), host):
                return process_request(connection, request)
            return connection.respond(403, "expected a request of this server's own page\n")

        return serve(*arguments, process_request=check, **options)

    quiet = contextlib.redirect_stdout(io.StringIO())  # viser's own banner
    with _starting, quiet:
        websockets.asyncio.server.serve = serve_own  # type: ignore[assignment,misc]
        try:
            server = _Server(host, port, label="ARDEE", verbose=False)
        finally:
            websockets.asyncio.server.serve = serve  # type: ignore[misc]
    server.gui.configure_theme(show_share_button=False)
    return server
