"""What follows from the inputs: curves, growth maps, charts; cached and shared by sessions."""
