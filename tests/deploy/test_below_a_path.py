"""The dashboard below a path of another web server, with the rules that docs/deploy.md gives."""

import os
import re
import ssl
import subprocess
import sys
from urllib.parse import urljoin

import pytest

from deploy.nginx import find_nginx
from tests.testing.lab import (
    APP_FOLDER,
    NEEDS_NGINX,
    PATIENCE,
    Lab,
    ask,
    certify,
)
from tests.testing.serving import START, free_port

pytestmark = NEEDS_NGINX


OUTSIDE = """
daemon off;
pid "{folder}/nginx.pid";
error_log stderr warn;
events {{}}
http {{
    access_log off;
    client_body_temp_path "{folder}/body";
    proxy_temp_path "{folder}/proxy";
    fastcgi_temp_path "{folder}/fastcgi";
    uwsgi_temp_path "{folder}/uwsgi";
    scgi_temp_path "{folder}/scgi";
    server {{
        listen 127.0.0.1:{port} ssl;
        ssl_certificate "{folder}/certificate.pem";
        ssl_certificate_key "{folder}/key.pem";
        location / {{ return 200 "another service"; }}
{rules}
    }}
}}
"""


def documented_rules(port):
    """Return the rules that docs/deploy.md has for an outside nginx, for an inner port."""
    text = (START.parents[1] / "docs" / "deploy.md").read_text(encoding="utf-8")
    return re.search(r"```nginx\n(.*?)```", text, re.S)[1].replace("5006", str(port))


@pytest.fixture(scope="module")
def behind(tmp_path_factory):
    """A lab below /rotorstab/, and the port of a distribution's nginx with TLS before it."""
    outer = free_port()
    lab = Lab(
        tmp_path_factory.mktemp("behind"),
        app=APP_FOLDER,
        origins=[f"localhost:{outer}"],
        ROTORSTAB_PREFIX="/rotorstab",
        ROTORSTAB_OUTSIDE_TLS="yes",
    )
    certify(lab.temporary / "key.pem", lab.temporary / "certificate.pem")
    configuration = lab.temporary / "outside.conf"
    configuration.write_text(
        OUTSIDE.format(folder=lab.temporary, port=outer, rules=documented_rules(lab.port))
    )
    front = subprocess.Popen(
        [find_nginx(), "-e", "stderr", "-p", str(lab.temporary), "-c", configuration]
    )
    try:
        for port in lab.ports:
            lab.wait_for(lambda port=port: lab.worker(port, "/rotorstab/health")[0] == 200)
        lab.outer = outer
        lab.trusted = ssl.create_default_context(cafile=lab.temporary / "certificate.pem")
        yield lab
    finally:
        front.terminate()
        front.wait(PATIENCE)
        lab.stop()


@pytest.mark.long
def test_below_a_path_of_another_name_everything_is_found(behind):
    def reply(path):
        return ask(behind.outer, path, behind.trusted)

    for path in ("/rotorstab", "/rotorstab/", "/rotorstab/app/"):
        status, headers, _ = reply(f"{path}?spin=1")
        assert status == 302
        assert headers["Location"].removeprefix(f"https://localhost:{behind.outer}") == (
            "/rotorstab/app?spin=1"
        )
    status, headers, page = reply("/rotorstab/app")
    assert status == 200
    assert headers["Set-Cookie"].endswith("; Path=/rotorstab/; HttpOnly; SameSite=Lax; Secure")
    named = re.findall(r'(?:src|href)="([^"]*static/[^"]*)"', page)
    files = {urljoin("/rotorstab/app", one) for one in named}
    assert any("bokeh.min.js" in one for one in files)
    for path in files:
        assert path.startswith("/rotorstab/static/")
        assert (path, reply(path)[0]) == (path, 200)
    assert reply("/rotorstab/static/js/bokeh.js")[0] == 404
    status, _, page = reply("/rotorstab/nothing")
    assert status == 404
    assert '<a href="/rotorstab/app">' in page
    assert reply("/app")[2] == "another service"
    done = subprocess.run(
        [sys.executable, "-m", "deploy.check", "/app"],
        env=os.environ | {"PORT": str(behind.port), "ROTORSTAB_PREFIX": "/rotorstab"},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.stdout == "/rotorstab/app: 200\n"


@pytest.mark.long
@pytest.mark.browser
def test_a_browser_uses_the_page_below_a_path_over_tls_that_ends_outside(browser, behind):
    context = browser.new_context(ignore_https_errors=True)
    try:
        page = context.new_page()
        failed = []
        page.on("requestfailed", lambda request: failed.append(request.url))
        page.on("response", lambda reply: reply.status >= 400 and failed.append(reply.url))
        page.goto(f"https://localhost:{behind.outer}/rotorstab/app?v=1&spin=1.5")
        page.wait_for_function("window.rotorstab?.last?.values?.spin_speed === 1.5", timeout=60_000)
        page.evaluate("rotorstab.change('shear', 0.01)")
        page.wait_for_function("location.search.includes('phi=0.01')")
        assert page.evaluate("location.pathname") == "/rotorstab/app"
        assert failed == []
    finally:
        context.close()
