"""Results as sentences and as numbers with units, for the page."""
