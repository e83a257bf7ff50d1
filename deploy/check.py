"""Health check of the server on ADDRESS:PORT: exit code 0 or 1, for a container's HEALTHCHECK.

`python -m deploy.check /health` asks a worker, `python -m deploy.check /app` asks nginx for the
page's head, which a worker must answer.
"""

import http.client
import ssl
import sys

from .settings import host_name, read

PATIENCE = 4  # s
LOCAL = {"0.0.0.0": "127.0.0.1", "::": "::1"}  # where a server listens that listens everywhere


def main() -> int:
    """Ask the server, print its answer, and return the exit code."""
    settings = read()
    address = LOCAL.get(settings.address, settings.address)
    path = settings.prefix + (sys.argv[1] if len(sys.argv) > 1 else "/health")
    connection = http.client.HTTPConnection(address, settings.port, timeout=PATIENCE)
    try:
        connection.connect()
        if settings.tls_certificate:
            connection.sock = unchecked().wrap_socket(
                connection.sock, server_hostname=host_name(settings.origins[0])
            )
        connection.request("HEAD", path, headers={"Host": settings.origins[0]})
        status = connection.getresponse().status
    except (OSError, http.client.HTTPException) as problem:
        print(f"{path}: {problem or type(problem).__name__}")
        return 1
    finally:
        connection.close()
    print(f"{path}: {status}")
    return 0 if status == 200 else 1


def unchecked() -> ssl.SSLContext:
    """Return TLS that verifies no certificate: this machine asks itself by another name."""
    context = ssl.create_default_context()
    context.check_hostname = False
    context.verify_mode = ssl.CERT_NONE
    return context


if __name__ == "__main__":
    sys.exit(main())
