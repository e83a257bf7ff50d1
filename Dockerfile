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
COPY app app
COPY deploy deploy
RUN /opt/rotorstab/bin/python -m pip install --no-deps --no-build-isolation . \
    && /opt/rotorstab/bin/python -m pip uninstall --yes hatchling pathspec pluggy trove-classifiers pip

# hadolint ignore=DL3006
FROM ${BASE} AS worker
LABEL org.opencontainers.image.title="rotorstab" \
      org.opencontainers.image.licenses="BSD-3-Clause"
COPY --from=build /opt/rotorstab /opt/rotorstab
WORKDIR /srv/rotorstab
# The workers write below /tmp only, and once the secret: the root file system may be read-only.
RUN install -d -m 0700 -o 10001 -g 10001 /var/lib/rotorstab
# hadolint ignore=DL3064
ENV PATH=/opt/rotorstab/bin:$PATH \
    PYTHON=/opt/rotorstab/bin/python \
    PYTHONDONTWRITEBYTECODE=1 \
    PYTHONUNBUFFERED=1 \
    HOME=/tmp \
    MPLCONFIGDIR=/tmp/matplotlib \
    ADDRESS=0.0.0.0 \
    PORT=5006 \
    ROTORSTAB_ORIGINS=localhost:5006,127.0.0.1:5006 \
    ROTORSTAB_SECRET_FILE=/var/lib/rotorstab/secret
USER 10001:10001
VOLUME /var/lib/rotorstab
EXPOSE 5006
HEALTHCHECK --interval=30s --timeout=5s --start-period=60s --retries=3 \
    CMD ["python", "-m", "deploy.check", "/health"]
ENTRYPOINT ["python", "-m", "deploy.worker"]

# nginx of the distribution, with the template and the launcher that are used without Docker.
FROM worker AS proxy
USER 0:0
# hadolint ignore=DL3008
RUN apt-get update \
    && apt-get install --yes --no-install-recommends nginx-light \
    && rm -rf /var/lib/apt/lists/*
USER 10001:10001
HEALTHCHECK --interval=30s --timeout=5s --start-period=60s --retries=3 \
    CMD ["python", "-m", "deploy.check", "/app"]
ENTRYPOINT ["python", "-m", "deploy.lab"]

# without a target: one worker
FROM worker
