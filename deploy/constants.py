"""What the workers and nginx say alike."""

RETRY_SECONDS = 30  # for whom there is no place
RESTART_SECONDS = 5  # while a server ends or starts
BUSY_SECONDS = 5  # for whom asks too often

LONGEST_ADDRESS = 128_000  # characters; 414 above, through nginx as on a worker's own port
HEADER_BUFFER = 131_072  # bytes; an address of that length in its request line

PAGE_FILES = (
    r"/static/(js/bokeh(-[a-z]+)?\.min\.js"
    r"|extensions/panel/(panel\.min\.js|css/[a-z_]+\.css|images/[a-z0-9_-]+\.(ico|png|svg|webmanifest)"
    r"|bundled/(datatabulator|reactiveesm|theme)/[A-Za-z0-9@^._/-]+\.(js|css)))"
)
"""Decoded paths of the scripts and styles that the page uses; all else below `/static/` is 404."""

HEADERS = {
    # CustomJS needs 'unsafe-eval', inline scripts have no nonces, and Panel's JavaScript
    # components are fetched from blobs.
    "Content-Security-Policy": (
        "default-src 'self'; script-src 'self' 'unsafe-inline' 'unsafe-eval' blob:; "
        "style-src 'self' 'unsafe-inline'; img-src 'self' data: blob:; connect-src 'self' blob:; "
        "frame-ancestors 'none'; object-src 'none'; base-uri 'self'; form-action 'self'"
    ),
    "Cross-Origin-Opener-Policy": "same-origin",
    "Cross-Origin-Resource-Policy": "same-origin",
    "Permissions-Policy": "camera=(), geolocation=(), microphone=()",
    "Referrer-Policy": "same-origin",
    "X-Content-Type-Options": "nosniff",
    "X-Frame-Options": "DENY",
}
