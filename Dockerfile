ARG BASE=python:3.13-slim

# hadolint ignore=DL3006
FROM ${BASE} AS build
WORKDIR /build
ENV PIP_DISABLE_PIP_VERSION_CHECK=1 PIP_NO_CACHE_DIR=1 PIP_NO_INPUT=1
RUN python3 -m venv /opt/rotorstab
COPY requirements/serve.txt requirements/
RUN /opt/rotorstab/bin/python -m pip install --require-hashes --requirement requirements/serve.txt
COPY pyproject.toml README.md LICENSE ./
COPY src src
RUN /opt/rotorstab/bin/python -m pip install --no-deps --no-build-isolation . \
    && /opt/rotorstab/bin/python -m pip uninstall --yes hatchling trove-classifiers pathspec pip

# hadolint ignore=DL3006
FROM ${BASE}
LABEL org.opencontainers.image.title="rotorstab" \
      org.opencontainers.image.licenses="BSD-3-Clause"
COPY --from=build /opt/rotorstab /opt/rotorstab
WORKDIR /srv/rotorstab
COPY deploy deploy
COPY app app
# Nothing is written but below /tmp: the root file system may be read-only.
ENV PATH=/opt/rotorstab/bin:$PATH \
    PYTHON=/opt/rotorstab/bin/python \
    PYTHONDONTWRITEBYTECODE=1 \
    PYTHONUNBUFFERED=1 \
    HOME=/tmp \
    MPLCONFIGDIR=/tmp/matplotlib \
    ADDRESS=0.0.0.0 \
    PORT=5006 \
    ROTORSTAB_ORIGINS=localhost:5006 \
    ROTORSTAB_MAX_SESSIONS=60 \
    BOKEH_SIGN_SESSIONS=yes \
    BOKEH_RESOURCES=server
USER 10001:10001
EXPOSE 5006
HEALTHCHECK --interval=30s --timeout=5s --start-period=30s --retries=3 \
    CMD ["python", "-c", "import os, urllib.request as r; r.urlopen(f\"http://127.0.0.1:{os.environ['PORT']}/health\", timeout=4)"]
ENTRYPOINT ["sh", "/srv/rotorstab/deploy/start.sh"]
