"""What a user takes away: files of charts, the report, the view as a program."""
