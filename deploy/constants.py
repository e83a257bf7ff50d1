"""Values that the workers and nginx share."""

RETRY_SECONDS = 30  # where all places are taken
RESTART_SECONDS = 5  # while a server ends or starts
BUSY_SECONDS = 5  # where pages are asked for too often

LONGEST_ADDRESS = 128_000  # characters; a longer one is answered 414 by nginx and by workers
HEADER_BUFFER = 131_072  # bytes; room for a request line with an address of that length

PAGE_FILES = (
    r"/static/(js/bokeh(-[a-z]+)?\.min\.js"
    r"|extensions/panel/(panel\.min\.js|css/[a-z_]+\.css|images/[a-z0-9_-]+\.(ico|png|svg|webmanifest)"
    r"|bundled/(datatabulator|reactiveesm|theme)/[A-Za-z0-9@^._/-]+\.(js|css)))"
)
"""Decoded paths of the scripts and styles that the page uses; others below `/static/` are 404."""

HEADERS = {  # values without double quotes, between which nginx's configuration writes them
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
